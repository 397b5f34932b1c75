#pragma once

#include <string>

#include "report/figures.hpp"
#include "report/record.hpp"

namespace breccia::report {

/// The report: one HTML page that needs nothing beside it. @param made  when, UTC, ISO 8601
[[nodiscard]] std::string page_of(const RunRecord& run, const Figures& figures, const std::string& made);

// Its sections, in their order; each is empty where a run has nothing to show.
[[nodiscard]] std::string key_figures(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string warnings(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string pictures(const Figures& figures);
[[nodiscard]] std::string energies(const RunRecord& run);
[[nodiscard]] std::string cracks(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string fragments(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string events(const Figures& figures);
[[nodiscard]] std::string contacts(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string gauges(const RunRecord& run);
[[nodiscard]] std::string model(const RunRecord& run);
[[nodiscard]] std::string effort(const RunRecord& run, const Figures& figures);
[[nodiscard]] std::string origin(const RunRecord& run, const Figures& figures, const std::string& made);

}  // namespace breccia::report
