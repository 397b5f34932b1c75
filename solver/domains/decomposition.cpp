#include "domains/decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/extent.hpp"
#include "case/problem_at.hpp"
#include "parallel/whole_fragments.hpp"

namespace breccia {
namespace {

Extent extent_of(const ElementRecord& element) {
  Extent extent;
  for (const auto& x : element.position) extent.add(Vec3(x[0], x[1], x[2]));
  return extent;
}

Vec3 centroid(const ElementRecord& element) {
  Vec3 sum = Vec3::Zero();
  for (const auto& x : element.position) sum += Vec3(x[0], x[1], x[2]);
  return 0.25 * sum;
}

/// Where elements count as lying, mine among those of all ranks.
std::vector<Vec3> places(const Communicator& communicator, const Records& mine, std::span<const Vec3> centroid,
                         double reach) {
  std::vector<GlobalId> ids;  // by themselves: a search through the records misses the cache at every access
  for (const ElementRecord& element : mine.elements) ids.push_back(element.id);
  const auto place_of = [&](std::size_t e, GlobalId id) {
    const auto near = static_cast<std::ptrdiff_t>(e) + (id - ids[e]);  // as long as all elements are on one rank
    if (near >= 0 && near < std::ssize(ids) && ids[static_cast<std::size_t>(near)] == id)
      return static_cast<Index>(near);
    const auto found = std::lower_bound(ids.begin(), ids.end(), id);
    return found != ids.end() && *found == id ? static_cast<Index>(found - ids.begin()) : FaceLink::kBeyond;
  };
  std::vector<std::array<Index, 4>> neighbours(ids.size());
  for (std::size_t e = 0; e < ids.size(); ++e) {
    const ElementRecord& element = mine.elements[e];
    for (std::size_t f = 0; f < 4; ++f) {
      const bool free = element.neighbour[f] < 0 || (element.released >> f & 1) != 0;
      neighbours[e][f] = free ? FaceLink::kFree : place_of(e, element.neighbour[f]);
    }
  }
  const auto all = static_cast<double>(communicator.sum(static_cast<std::int64_t>(ids.size())));
  return places_of_fragments(centroid, neighbours, all / communicator.size(), reach);
}

/// Elements by the rank that wants them, ascending: places in a rank's records.
using Wanted = std::vector<std::vector<Index>>;

std::vector<std::uint8_t> marks_of(const std::vector<Index>& places, std::size_t elements) {
  std::vector<std::uint8_t> marks(elements, 0);
  for (const Index e : places) marks[static_cast<std::size_t>(e)] = 1;
  return marks;
}

/// Sends elements to the ranks that want them.
std::vector<Communicator::Parcel> exchange(const Communicator& communicator, const Records& records,
                                           const Wanted& wanted) {
  std::vector<Communicator::Parcel> parcels;
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    if (!wanted[r].empty())
      parcels.push_back({static_cast<int>(r), pack(records, marks_of(wanted[r], records.elements.size()))});
  }
  return communicator.exchange(std::move(parcels));
}

Records migrate(const Communicator& communicator, Records mine, const std::vector<int>& owner) {
  Wanted wanted(static_cast<std::size_t>(communicator.size()));
  for (std::size_t e = 0; e < owner.size(); ++e)
    wanted[static_cast<std::size_t>(owner[e])].push_back(static_cast<Index>(e));
  const std::vector<Index> stay = std::exchange(wanted[static_cast<std::size_t>(communicator.rank())], {});
  Records arrivals;
  for (const Communicator::Parcel& parcel : exchange(communicator, mine, wanted)) unpack(parcel.bytes, arrivals);
  keep(mine, marks_of(stay, mine.elements.size()));
  merge(mine, std::move(arrivals));
  return mine;
}

/// Originals that other ranks need.
Wanted needed_elsewhere(const Communicator& communicator, const Records& owned, const Reach& reach) {
  std::vector<Extent> elements;
  std::vector<std::array<GlobalId, 4>> vertices;
  Extent all;
  for (const ElementRecord& element : owned.elements) {
    all.add(elements.emplace_back(extent_of(element)));
    vertices.push_back(element.vertex);
  }
  const std::vector<double> distance = distances(communicator, vertices, longest_edges(owned), reach);
  const double most = distance.empty() ? 0.0 : *std::max_element(distance.begin(), distance.end());
  const std::vector<std::vector<Extent>> extents = communicator.all_gather(std::span<const Extent>(&all, 1));
  Wanted wanted(extents.size());
  for (std::size_t r = 0; r < extents.size(); ++r) {
    if (static_cast<int>(r) == communicator.rank() || !all.near(extents[r][0], most)) continue;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (elements[e].near(extents[r][0], distance[e])) wanted[r].push_back(static_cast<Index>(e));
    }
  }
  return wanted;
}

}  // namespace

Reach reach_of(const case_::Case& input, double edge, double buffer) {
  const bool shared_nodes = std::any_of(input.materials.begin(), input.materials.end(), [](const case_::Material& m) {
    return m.joints == case_::JointPlacement::none;
  });
  return {input.domains.margin * edge, 2 * buffer, shared_nodes ? 2 : 1, shared_nodes ? 3 : 0};
}

std::vector<double> distances(const Communicator& communicator, std::span<const std::array<GlobalId, 4>> vertices,
                              std::vector<double> size, const Reach& reach) {
  std::vector<double> distance = sizes_around(communicator, vertices, std::move(size), reach.most_rings());
  for (double& each : distance) each = reach.distance(each);
  return distance;
}

DomainSpec domain_spec(const case_::Case& input) {
  const case_::Domains& asked = input.domains;
  const case_::KeyPlace place = case_::place_of(input.file, asked.origin, "n");
  return {
      asked.kind == case_::DomainKind::grid ? DomainKind::grid : DomainKind::rcb, asked.n, place.file, place.line, {}};
}

Piece decompose(const Communicator& communicator, DomainSpec& domains, Records mine, const std::vector<double>& weight,
                const Sizes& sizes, const Reach& reach) {
  std::vector<Vec3> centroids;
  for (const ElementRecord& element : mine.elements) centroids.push_back(centroid(element));
  domains = settled(communicator, domains, communicator.size(), centroids, sizes.largest);
  const std::vector<Vec3> place = places(communicator, mine, centroids, reach.distance(sizes.mean));
  const std::vector<int> owner =
      assign_domains(communicator, domains, communicator.size(), place, weight, sizes.largest);
  Records owned = migrate(communicator, std::move(mine), owner);

  Piece piece;
  const Wanted wanted = needed_elsewhere(communicator, owned, reach);
  std::vector<SharedElements> by_rank(wanted.size());
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    by_rank[r].rank = static_cast<int>(r);
    for (const Index e : wanted[r]) by_rank[r].send.push_back(owned.elements[static_cast<std::size_t>(e)].id);
  }
  const std::vector<Communicator::Parcel> parcels = exchange(communicator, owned, wanted);
  std::vector<GlobalId> own_ids;
  for (const ElementRecord& element : owned.elements) own_ids.push_back(element.id);
  piece.records = std::move(owned);
  Records proxies;
  for (const Communicator::Parcel& parcel : parcels) {
    const std::size_t before = proxies.elements.size();
    unpack(parcel.bytes, proxies);
    auto& receive = by_rank[static_cast<std::size_t>(parcel.rank)].receive;
    for (std::size_t e = before; e < proxies.elements.size(); ++e) receive.push_back(proxies.elements[e].id);
  }
  merge(piece.records, std::move(proxies));
  for (const ElementRecord& element : piece.records.elements) {
    piece.original.push_back(std::binary_search(own_ids.begin(), own_ids.end(), element.id) ? 1 : 0);
  }
  for (SharedElements& neighbour : by_rank) {
    if (!neighbour.send.empty() || !neighbour.receive.empty()) piece.neighbours.push_back(std::move(neighbour));
  }
  return piece;
}

}  // namespace breccia
