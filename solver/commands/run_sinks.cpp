#include "commands/run_sinks.hpp"

#include <cstdio>
#include <iostream>

#include "base/printable.hpp"
#include "output/folder/bodies_sink.hpp"
#include "output/folder/history_sink.hpp"
#include "output/folder/summary.hpp"
#include "output/frames/vtkhdf_sink.hpp"

namespace breccia {

std::vector<std::unique_ptr<Sink>> run_sinks(const case_::Case& input, const RunFolder& folder, ProgressMode progress,
                                             const Communicator& world) {
  std::vector<std::unique_ptr<Sink>> sinks;
  world.agree([&] {
    const FrameParts parts{input.output.elements, input.output.joints, input.output.contacts};
    sinks.push_back(std::make_unique<VtkhdfSink>(folder.frames(), parts, world));
    if (!world.is_root()) return;
    sinks.push_back(std::make_unique<BodiesSink>(folder.bodies()));
    sinks.push_back(std::make_unique<HistorySink>(folder.history()));
    sinks.push_back(std::make_unique<StatusSink>(folder.status()));
    sinks.push_back(std::make_unique<ProgressSink>(progress, std::cout, terminal_columns(fileno(stdout))));
    sinks.push_back(std::make_unique<SummarySink>(folder.summary(), folder.summary_text()));
  });
  return sinks;
}

void print_results(const Summary& summary, const RunFolder& folder, ProgressMode progress, const Communicator& world) {
  if (world.is_root() && progress != ProgressMode::json)
    std::cout << printable_lines(summary_text(summary) + "results in " + folder.root.string())
              << std::endl;  // which throws nothing
}

}  // namespace breccia
