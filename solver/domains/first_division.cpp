#include "domains/first_division.hpp"

#include <algorithm>
#include <optional>

#include "base/index.hpp"
#include "domains/mesh_records.hpp"
#include "mesh/geometry.hpp"
#include "physics/contact/geometry/field.hpp"

namespace breccia {
namespace {

/// First element of a rank's run of the ids.
Index first_of(int rank, std::int64_t elements, int ranks) { return static_cast<Index>(elements * rank / ranks); }

/// Makes records of elements in their order.
class RestRecords {
 public:
  RestRecords(const Model& bare, const Contactors& contactors)
      : bare_(bare), contactors_(contactors), faces_(face_tags(bare.mesh, bare.topology)) {}

  void append(Index element, Records& records) {
    ElementRecord record = mesh_record(bare_.mesh, bare_.topology, element);
    record.position = record.reference;
    record.torn = bare_.torn[at(element)];
    if (!contactors_.chosen.empty() && contactors_.chosen[at(element)] != 0) {
      record.contactor = 1;
      record.field = field_at_rest(bare_.contact.field, bare_.mesh, element, contactors_.surface);
    }
    append_tags(faces_, record.id, next_face_, records.faces);
    append_tags(bare_.corner_tags, record.id, next_corner_, records.corners);
    records.elements.push_back(record);
  }

 private:
  const Model& bare_;
  const Contactors& contactors_;
  std::vector<FaceTag> faces_;
  std::size_t next_face_ = 0, next_corner_ = 0;
};

}  // namespace

Records spread(const Communicator& communicator, const Model* bare, const Contactors& contactors) {
  const std::int64_t elements = communicator.max(bare != nullptr ? std::int64_t{bare->mesh.num_elements()} : 0);
  std::optional<RestRecords> source;
  if (bare != nullptr) source.emplace(*bare, contactors);
  Records mine;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    const Index end = first_of(rank + 1, elements, communicator.size());
    for (Index first = first_of(rank, elements, communicator.size()); first < end; first += kElementsAtATime) {
      Records part;
      for (Index e = first; source && e < std::min(end, first + kElementsAtATime); ++e) source->append(e, part);
      if (rank == 0) {
        if (source) merge(mine, std::move(part));
        continue;
      }
      std::vector<Communicator::Parcel> parcels;
      if (source) parcels.push_back({rank, pack(part, std::vector<std::uint8_t>(part.elements.size(), 1))});
      for (const Communicator::Parcel& parcel : communicator.exchange(std::move(parcels))) unpack(parcel.bytes, mine);
    }
  }
  return mine;
}

}  // namespace breccia
