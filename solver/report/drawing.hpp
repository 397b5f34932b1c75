#pragma once

#include <chrono>
#include <filesystem>

#include "report/figures.hpp"

namespace breccia::report {

/// Lets ParaView make pictures and statistics of a run's frames: pvpython with the plugin, in a process of its own with
/// a screen of its own (xvfb-run; the environment's DISPLAY where that is missing; without either only statistics). The
/// search path of the plugin is as for the in-situ adaptor (output/insitu/insitu_plugin.hpp): the environment's
/// BRECCIA_PARAVIEW_PLUGIN, or relative to the program's folder, ../lib/breccia/paraview/Breccia where both are
/// installed and ../plugins/lib/breccia/paraview/Breccia where they were built; the script lies beside it.
/// Missing parts and failures are reported in the result, never thrown. SIGINT, SIGTERM and SIGHUP end ParaView as
/// well.
/// @param up     'x', 'y' or 'z'
/// @param limit  of wall time; then the finished parts are used
[[nodiscard]] Figures draw_run(const std::filesystem::path& run, char up, std::chrono::seconds limit);

}  // namespace breccia::report
