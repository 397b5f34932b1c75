#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>

#include "experiments.hpp"
#include "peers.hpp"

namespace breccia::lab {
namespace {

constexpr int num_cycles = 10;

/// Cumulative detection times of the ten cycles over all runs.
struct Times {
  double least = 1e300, most = 0;
  double first_cycle = 1e300;  ///< of the run whose first cycle was shortest
  std::size_t bytes = 0;
};

struct Case {
  std::string experiment;
  std::size_t n;
  int spacing;
};

Contenders make_contenders(const Options& options) {
  Contenders all = own_searches();
  PointContenders unused;
  if (options.peers) add_peers(all, unused);
  std::erase_if(all, [&](const auto& one) { return !wanted(options, one->name()); });
  return all;
}

/// Time of the next case from the last one's, as if its growth from the last but one continued.
class Forecast {
 public:
  void tell(double n, double time) {
    exponent_ = n_ > 0 && n > n_ ? std::clamp(std::log(time / time_) / std::log(n / n_), 1.0, 2.0) : exponent_;
    n_ = n;
    time_ = time;
  }
  double time(double n) const { return n_ > 0 ? time_ * std::pow(n / n_, exponent_) : 0; }

 private:
  double n_ = 0, time_ = 0, exponent_ = 1.2;
};

using Forecasts = std::map<std::string, Forecast>;

/// One run: all contenders see the same cells in every cycle and must see the same pairs. Returns the pairs of all
/// cycles.
Tally run_once(const Case& one, Contenders& contenders, std::map<std::string, Times>& times) {
  Placement placement(one.experiment, one.n, one.spacing);
  std::map<std::string, double> sum;
  Tally all;
  for (int cycle = 0; cycle < num_cycles; ++cycle) {
    Tally first;
    for (auto& contender : contenders) {
      const double start = now();
      const Tally tally = contender->detect(placement.cells());
      const double time = now() - start;
      sum[contender->name()] += time;
      Times& record = times[contender->name()];
      if (cycle == 0) record.first_cycle = std::min(record.first_cycle, time);
      record.bytes = contender->bytes();
      if (contender == contenders.front()) first = tally;
      if (tally != first) {
        throw std::runtime_error(one.experiment + ", " + std::to_string(one.n) + " bodies, cycle " +
                                 std::to_string(cycle) + ": " + contender->name() + " sees " +
                                 std::to_string(tally.count) + " pairs, " + contenders.front()->name() + " " +
                                 std::to_string(first.count) + " (or others)");
      }
    }
    all.count += first.count;
    all.checksum += first.checksum;
    placement.move();
  }
  for (const auto& [name, time] : sum) {
    times[name].least = std::min(times[name].least, time);
    times[name].most = std::max(times[name].most, time);
  }
  return all;
}

bool fits_memory(const Case& one) {
  constexpr double bytes_a_body = 700;  // all contenders of a case live at once
  const double available = static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes_a_body * static_cast<double>(one.n) < available) return true;
  std::printf("%-4s N=%zu skipped: may need more than the %.1f GB of memory that are free\n", one.experiment.c_str(),
              one.n, available * 1e-9);
  return false;
}

void run_case(const Case& one, const Options& options, Forecasts& forecasts, std::ofstream& table) {
  if (!fits_memory(one)) return;
  const auto bodies = static_cast<double>(one.n);
  const auto too_slow = [&](const auto& contender) {
    const double expected = forecasts[contender->name()].time(bodies);
    if (expected <= options.budget) return false;
    std::printf("%-4s N=%zu %s skipped: about %.0f s, more than the budget\n", one.experiment.c_str(), one.n,
                contender->name().c_str(), expected);
    return true;
  };
  std::map<std::string, Times> times;
  Tally tally;
  std::vector<std::string> names;
  for (int run = 0; run < options.repeat; ++run) {
    Contenders contenders = make_contenders(options);
    if (run == 0) {
      std::erase_if(contenders, too_slow);
      for (const auto& contender : contenders) names.push_back(contender->name());
    }
    std::erase_if(contenders,
                  [&](const auto& c) { return std::find(names.begin(), names.end(), c->name()) == names.end(); });
    if (contenders.empty()) return;
    tally = run_once(one, contenders, times);
  }
  for (const std::string& name : names) {
    const Times& t = times[name];
    forecasts[name].tell(bodies, t.least);
    std::printf("%-4s N=%-9zu s=%-4d %-14s %10.4f s  (to %.4f; first cycle %.4f)  %6.1f ns a body and cycle\n",
                one.experiment.c_str(), one.n, one.spacing, name.c_str(), t.least, t.most, t.first_cycle,
                t.least * 1e9 / bodies / num_cycles);
    table << one.experiment << ',' << name << ',' << one.n << ',' << one.spacing << ',' << t.least << ',' << t.most
          << ',' << t.first_cycle << ',' << tally.count << ',' << tally.checksum << ',' << t.bytes << '\n';
  }
  table.flush();
  std::fflush(stdout);
}

std::size_t cube_near(std::size_t n) {
  const auto edge = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(n))));
  return edge * edge * edge;
}

std::vector<Case> cases_of(const std::string& experiment, std::size_t largest) {
  std::vector<Case> cases;
  if (experiment == "II") {
    for (const int spacing : {1, 2, 5, 10, 20, 50, 100, 200}) {
      cases.push_back({experiment, cube_near(std::min<std::size_t>(largest, 1'000'000)), spacing});
    }
  } else if (experiment == "IV") {
    for (std::size_t n = 500; n <= std::min<std::size_t>(largest, 16000); n *= 2) cases.push_back({experiment, n, 1});
  } else {
    const bool cubes = experiment == "I" || experiment == "III";
    for (const std::size_t n :
         {10'000U, 30'000U, 100'000U, 300'000U, 1'000'000U, 3'000'000U, 10'000'000U, 30'000'000U}) {
      if (n <= largest) cases.push_back({experiment, cubes ? cube_near(n) : n, 1});
    }
  }
  return cases;
}

}  // namespace

void run_equal_size(const Options& options) {
  std::ofstream table(options.folder / "equal_size.csv");
  table << "experiment,algorithm,bodies,spacing,least_s,most_s,first_cycle_s,pairs,checksum,bytes\n";
  for (const std::string& experiment : options.experiments) {
    if (experiment == "VII" || experiment == "bytes" || experiment == "points") continue;
    Forecasts forecasts;
    for (const Case& one : cases_of(experiment, options.largest)) run_case(one, options, forecasts, table);
  }
}

void run_bytes(const Options& options) {
  std::ofstream table(options.folder / "bytes.csv");
  table << "algorithm,bodies,bytes_int16,bytes_int32\n";
  write_bytes(cube_near(std::min<std::size_t>(options.largest, 1'000'000)), table);
}

}  // namespace breccia::lab
