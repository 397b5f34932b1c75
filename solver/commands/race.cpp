#include "commands/race.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <chrono>
#include <set>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/quantity_text.hpp"
#include "case/schema.hpp"
#include "commands/stage_driver.hpp"
#include "commands/timing_segments.hpp"
#include "domains/state_records.hpp"
#include "observe/observe.hpp"
#include "simulation/run.hpp"

namespace breccia {
namespace {

using WallClock = std::chrono::steady_clock;

constexpr int kRounds = 3;
/// A repetition whose length is not given: see race_case.
constexpr std::int64_t kSearches = 10, kFewestSteps = 50;
constexpr double kAllRepetitions = 60;  ///< s
/// Steps between two checks of the wall time, by all ranks together.
constexpr std::int64_t kStepsBetweenChecks = 10;
constexpr std::int64_t kMostPieces = 1000;  ///< of a repetition (TimingSegments)
/// Points times contactors of a rank up to which all against all may race: some 60 ms a search, at 6 ns a pair.
constexpr double kSmallEnough = 1e7;

double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// Points and contactors of this rank, proxies with them.
double pairs_of(const Partition& partition) {
  const ContactState& contact = partition.state().contact;
  return static_cast<double>(contact.points.size()) * static_cast<double>(contact.contactors.size());
}

std::int64_t couples_of(const Partition& partition) {
  const ContactState& contact = partition.state().contact;
  const auto mine = [&](const ContactCouple& couple) {
    return partition.model().local.is_original(contact.points[static_cast<std::size_t>(couple.point)].slot);
  };
  return partition.communicator().sum(
      static_cast<std::int64_t>(std::count_if(contact.couples.begin(), contact.couples.end(), mine)));
}

class Race {
 public:
  Race(const case_::Case& input, const RaceSettings& settings, RaceProgress& progress, const Communicator& communicator)
      : input_(input), settings_(settings), progress_(progress), communicator_(communicator) {
    input_.domains.rebalance = false;  // measured times would decide when
    input_.detection.verify = false;
    result_.title = input.title;
    result_.ranks = communicator.size();
  }

  RaceResult run(std::unique_ptr<Model> whole) {
    result_.stopped = !reach_start(std::move(whole)) || !warm_up() || !race();
    if (result_.rounds > 0) rank();
    progress_.finish();
    return result_;
  }

 private:
  /// False: stopped by request; so with all functions below.
  bool reach_start(std::unique_ptr<Model> whole) {
    if (!(settings_.from < input_.stages.back().end)) throw starts_too_late();
    const auto started = WallClock::now();
    Partition partition(input_, communicator_, std::move(whole));
    if (!partition.domain().contact) throw nothing_touches();
    result_.elements = partition.whole().num_elements;
    StageDriver driver(input_, partition);
    while (!driver.over() && partition.state().clock.time < settings_.from - 0.5 * partition.state().clock.dt) {
      driver.step(stop_requested);
      if (partition.state().signals.received.stop) return false;
      if (progress_.due())
        progress_.show(
            {"on the way to the start", partition.state().clock.time / settings_.from, seconds_since(started)});
    }
    if (driver.over()) throw starts_too_late();
    choose_algorithms(communicator_.max(pairs_of(partition)));
    result_.start = partition.state().clock.time;
    schedule_ = driver.schedule();
    start_ = partition.snapshot();
    return true;
  }

  void rank() {
    for (const TimingSegments& least : least_) least_.front().keep_least_rest(least);
    for (std::size_t i = 0; i < least_.size(); ++i) {
      least_[i].keep_least_rest(least_.front());
      least_[i].sum_up(entries_[i].least, communicator_.size() == 1);
    }
    result_.entries = entries_;
    std::stable_sort(result_.entries.begin(), result_.entries.end(),
                     [](const RaceEntry& a, const RaceEntry& b) { return a.least.lasting() < b.least.lasting(); });
  }

  [[nodiscard]] InputError starts_too_late() const {
    return InputError(Problem{input_.file.string(), 0, "--from", "the race would start at the end of the case or later",
                              "less than " + quantity_text(input_.stages.back().end, "s"),
                              quantity_text(settings_.from, "s")});
  }

  [[nodiscard]] InputError nothing_touches() const {
    return InputError(Problem{input_.file.string(), 0, "contact",
                              "nothing can touch: there is no contact to search for",
                              "a law in [[contact]] between the case's groups", ""});
  }

  void choose_algorithms(double pairs) {
    algorithms_ = settings_.algorithms;
    if (!algorithms_.empty()) return;
    using enum case_::DetectionAlgorithm;
    algorithms_ = {ms, ms_slices, sorted_grid, packed_tree};
    if (pairs <= kSmallEnough) {
      algorithms_.push_back(brute_force);
    } else {
      result_.left_out = fmt::format(
          "brute_force was left out: {:.2g} pairs of a point and an element at every search; "
          "--algorithms brute_force lets it race all the same",
          pairs);
    }
  }

  [[nodiscard]] std::size_t num_candidates() const {
    const std::set<double> multiples(settings_.buffers.begin(), settings_.buffers.end());
    return algorithms_.size() * (multiples.size() + (multiples.contains(1.0) ? 0 : 1));
  }

  /// @param own  m, the case's own buffer or, if it is automatic, the last one
  void choose_candidates(double own) {
    std::set<double> multiples(settings_.buffers.begin(), settings_.buffers.end());
    multiples.insert(1.0);
    for (const auto algorithm : algorithms_) {
      for (const double multiple : multiples) {
        const bool as_given = multiple == 1.0;
        const SearchCandidate candidate{algorithm, as_given ? input_.detection.buffer : rounded(multiple * own, 3),
                                        as_given && algorithm == input_.detection.algorithm};
        entries_.push_back({candidate, {}});
      }
    }
  }

  [[nodiscard]] bool length_given() const { return settings_.steps > 0 || settings_.time > 0; }

  bool warm_up() {
    const double most = kAllRepetitions / static_cast<double>(num_candidates() * kRounds + 1);
    double buffer = 0;
    const auto enough = [&](const Partition& partition, std::int64_t steps) {
      if (settings_.steps > 0) return steps >= settings_.steps;
      if (settings_.time > 0)
        return partition.state().clock.time >= result_.start + settings_.time - 0.5 * partition.state().clock.dt;
      if (steps >= kFewestSteps &&
          partition.state().counters.searches - start_.state.state.counters.searches > kSearches)
        return true;
      return steps % kStepsBetweenChecks == 0 && communicator_.max(seconds_since(started_)) > most;
    };
    started_ = WallClock::now();
    const SearchCandidate own{input_.detection.algorithm, input_.detection.buffer, true};
    const bool finished = run_repetition(own, enough, [&](const Partition& partition, const TimingSegments&) {
      buffer = communicator_.max(partition.domain().contact->searches().buffer());
      result_.steps = partition.state().clock.steps - start_.state.state.clock.steps;
      if (partition.state().counters.searches == start_.state.state.counters.searches) throw nothing_touches();
    });
    if (!finished) return false;
    choose_candidates(input_.detection.buffer > 0 ? input_.detection.buffer : buffer);
    piece_ = (result_.steps + kMostPieces - 1) / kMostPieces;
    return true;
  }

  bool race() {
    started_ = WallClock::now();
    const auto enough = [&](const Partition&, std::int64_t steps) { return steps >= result_.steps; };
    while (result_.rounds < kRounds) {
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        const std::size_t turn = result_.rounds % 2 == 0 ? i : entries_.size() - 1 - i;
        const auto take = [&](const Partition& partition, const TimingSegments& pieces) {
          finish_repetition(turn, partition, pieces);
        };
        if (!run_repetition(entries_[turn].candidate, enough, take)) return false;
      }
      ++result_.rounds;
      if (!length_given() && communicator_.max(seconds_since(started_)) > kAllRepetitions) break;
    }
    return true;
  }

  /// @param enough  (partition, steps): the repetition is over;  @param finish  (partition, pieces) at its end
  template <class Enough, class Finish>
  bool run_repetition(const SearchCandidate& candidate, const Enough& enough, const Finish& finish) {
    case_::Case as_raced = input_;
    as_raced.detection.algorithm = candidate.algorithm;
    as_raced.detection.buffer = candidate.buffer;
    Partition partition(as_raced, communicator_, start_);
    StageDriver driver(as_raced, partition, start_.stage, schedule_);
    communicator_.barrier();
    TimingSegments pieces(partition, piece_);
    std::int64_t steps = 0;
    while (!driver.over() && (steps == 0 || !enough(partition, steps))) {
      driver.step(stop_requested);
      ++steps;
      pieces.step(partition);
      if (partition.state().signals.received.stop) return false;
      if (progress_.due()) report_repetition(candidate, steps);
    }
    conclude(partition.domain());
    if (partition.state().signals.received.stop) return false;
    pieces.agree(communicator_);
    finish(partition, pieces);
    return true;
  }

  void finish_repetition(std::size_t turn, const Partition& partition, const TimingSegments& pieces) {
    ++repetitions_;
    result_.end = partition.state().clock.time;
    check_state(entries_[turn].candidate, hash_of(partition.domain()).text());
    if (result_.rounds > 0) return least_[turn].keep_least(pieces);
    Repetition& least = entries_[turn].least;
    least.searches = partition.state().counters.searches - start_.state.state.counters.searches;
    least.used = static_cast<double>(least.searches - 1) +
                 partition.domain().contact->searches().used_up(partition.state().nodes, communicator_);
    least.couples = couples_of(partition);
    least_.push_back(pieces);
  }

  void report_repetition(const SearchCandidate& candidate, std::int64_t steps) {
    if (entries_.empty()) return progress_.show({"warming up", 0, 0});
    const double done =
        static_cast<double>(repetitions_) + static_cast<double>(steps) / static_cast<double>(result_.steps);
    const auto all = static_cast<double>(entries_.size() * kRounds);
    progress_.show({fmt::format("repetition {} of {}: {}", repetitions_ + 1, all, candidate.name()), done / all,
                    seconds_since(started_)});
  }

  /// Results never depend on the contact search.
  void check_state(const SearchCandidate& candidate, const std::string& hash) {
    if (result_.state_hash.empty()) {
      first_ = candidate.name();
      result_.state_hash = hash;
    }
    DEMAND(hash == result_.state_hash, fmt::format("({}) ends in state {}, ({}) in state {} after the same {} steps",
                                                   first_, result_.state_hash, candidate.name(), hash, result_.steps));
  }

  case_::Case input_;
  const RaceSettings& settings_;
  RaceProgress& progress_;
  Communicator communicator_;
  Snapshot start_;
  StepSchedule schedule_;  ///< of the driver at the start
  std::vector<case_::DetectionAlgorithm> algorithms_;
  std::vector<RaceEntry> entries_;
  std::vector<TimingSegments> least_;  ///< (entries) of all repetitions
  std::int64_t piece_ = 1;             ///< steps
  std::size_t repetitions_ = 0;
  WallClock::time_point started_;  ///< the warm-up, then the race
  std::string first_;              ///< who has set the state in which all must end
  RaceResult result_;
};

}  // namespace

std::string SearchCandidate::algorithm_text() const {
  return case_::key_of("detection.algorithm").choice_list()[static_cast<std::size_t>(algorithm)];
}

std::string SearchCandidate::buffer_text() const { return buffer > 0 ? fmt::format("{} m", buffer) : "auto"; }

RaceResult race_case(const case_::Case& input, const RaceSettings& settings, std::unique_ptr<Model> whole,
                     RaceProgress& progress, const Communicator& communicator) {
  return Race(input, settings, progress, communicator).run(std::move(whole));
}

}  // namespace breccia
