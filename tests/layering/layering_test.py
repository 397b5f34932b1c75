"""The layering test is itself tested: a clean tree passes, and every kind of violation planted in it is found, alone."""

import tempfile
import unittest
from pathlib import Path

from layering import LEFT_OPEN, MAX_COLUMNS, MAX_LINES, problems

CLEAN = {
    "solver/main.cpp": '#include <CLI/CLI.hpp>\n#include "commands/commands.hpp"\n',
    "solver/commands/commands.hpp": "#pragma once\n#include <string>\n",
    "solver/base/types.hpp": "#include <Eigen/Core>\n#include <cstdint>\n",
    "solver/base/log.cpp": "#include <spdlog/spdlog.h>\n#include <fmt/format.h>\n",
    "solver/base/json_depth.hpp": "#include <string_view>\n",
    "solver/system/open_regular.hpp": "#include <fcntl.h>\n#include <string>\n",
    "solver/run_folder/history.hpp": '#include <vector>\n#include "run_folder/lines.hpp"\n#include "system/open_regular.hpp"\n',
    "solver/run_folder/status.hpp": '#include <nlohmann/json.hpp>\n#include "base/json_depth.hpp"\n',
    "solver/report/record.cpp": '#include "run_folder/history.hpp"\n',
    "catalyst/recorded.cpp": '#include "run_folder/history.hpp"\n#include "system/write_all.hpp"\n',
    "plugins/Breccia/Filters/brecciaRun.cxx": '#include <vtkTable.h>\n#include <vector>\n#include "brecciaRun.h"\n#include "run_folder/history.hpp"\n',
    "gui/core/runs.cpp": '#include "run_folder/status.hpp"\n',
    "solver/case/reader.cpp": '#include <toml++/toml.h>\n#include "base/error.hpp"\n',
    "solver/mesh/gmsh/module.cpp": '#include <gmsh.h>\n#include "mesh/mesh.hpp"\n',
    "solver/parallel/halo.cpp": '#include <mpi.h>\n#include "mesh/topology.hpp"\n',
    "solver/physics/contact/friction.cpp": '#include <Eigen/Dense>\n#include <experimental/simd>\n#include "discretisation/layout.hpp"\n',
    "solver/detection/point_body/ms.cpp": '#include "detection/point_body/search.hpp"\n',
    "solver/output/frames/hdf5_file.cpp": '#include <hdf5.h>\n#include "case/case.hpp"\n',
    "solver/output/insitu_sink.cpp": '#include <dlfcn.h>\n#include "catalyst/insitu_abi.h"\n',
    "solver/output/folder/summary.cpp": "#include <nlohmann/json.hpp>\n",
    "solver/simulation/step.cpp": '#include "physics/elasticity.hpp"\n#include "output/sink.hpp"\n',
    "catalyst/insitu_abi.h": "#include <stddef.h>\n#include <stdint.h>\n",
    "catalyst/live.cpp": '#include <vtkPython.h>\n#include <mpi.h>\n#include <sys/wait.h>\n#include <array>\n#include "catalyst/insitu_abi.h"\n',
    "gui/core/document.hpp": '#include <QObject>\n#include <QUndoStack>\n#include <signal.h>\n#include "base/error.hpp"\n#include "core/places.hpp"\n',
    "gui/render/scene.cpp": '#include <vtkActor.h>\n#include <cmath>\n#include "render/scene.hpp"\n',
    "gui/widgets/view3d.hpp": '#include <QVTKOpenGLNativeWidget.h>\n#include <QWidget>\n#include <vtkNew.h>\n#include "core/document.hpp"\n',
    "tests/unit/base/any_test.cpp": '#include <gtest/gtest.h>\n#include "physics/elasticity.hpp"\n',
}

# (file, content, part of the message)
VIOLATIONS = [
    ("solver/base/a.cpp", '#include "mesh/mesh.hpp"\n', "base must not include mesh/mesh.hpp"),
    ("solver/case/a.hpp", '#include "mesh/mesh.hpp"\n', "case must not include"),
    ("solver/mesh/a.cpp", '#include "case/case.hpp"\n', "mesh must not include"),
    ("solver/parallel/a.cpp", '#include "state/state.hpp"\n', "parallel must not include"),
    ("solver/state/a.cpp", '#include "contact/contact_search.hpp"\n', "state must not include"),
    ("solver/physics/a.cpp", '#include "state/state.hpp"\n', "physics must not include"),
    ("solver/discretisation/a.cpp", '#include "physics/sweep.hpp"\n', "discretisation must not include"),
    ("solver/contact/a.cpp", '#include "domains/domain.hpp"\n', "contact must not include"),
    ("solver/domains/a.cpp", '#include "output/frames/frame.hpp"\n', "domains must not include"),
    ("solver/observe/a.cpp", '#include "simulation/step.hpp"\n', "observe must not include"),
    ("solver/physics/a.cpp", '#include "case/case.hpp"\n', "physics must not include"),
    ("solver/physics/contact/a.cpp", '  #  include "output/frames/frame.hpp"\n', "physics must not include"),
    ("solver/detection/a.cpp", '#include "physics/elasticity.hpp"\n', "detection must not include"),
    ("solver/output/a.cpp", '#include "simulation/simulation.hpp"\n', "output must not include"),
    ("solver/simulation/a.cpp", '#include "catalyst/insitu_abi.h"\n', "simulation must not include"),
    ("solver/simulation/a.cpp", '#include "step.hpp"\n', "write the folder"),
    ("solver/base/a.hpp", "#include <spdlog/spdlog.h>\n", "only in base/log.cpp"),
    ("solver/case/schema.cpp", "#include <toml++/toml.h>\n", "only in case/*reader*.cpp"),
    ("solver/case/reader.hpp", "#include <toml++/toml.h>\n", "only in case/*reader*.cpp"),
    ("solver/mesh/finish.cpp", "#include <gmsh.h>\n", "only in mesh/gmsh/*.cpp"),
    ("solver/simulation/a.cpp", "#include <mpi.h>\n", "only in parallel/"),
    ("solver/parallel/halo.cpp", "#include <zoltan_cpp.h>\n", "not in the table"),
    ("solver/output/checkpoint/checkpoint.cpp", "#include <H5public.h>\n", "only in output/frames/hdf5"),
    ("solver/output/folder/summary.hpp", "#include <nlohmann/json_fwd.hpp>\n", "only in output/*.cpp"),
    ("solver/simulation/a.cpp", "#include <nlohmann/json.hpp>\n", "only in output/*.cpp"),
    ("solver/simulation/a.cpp", "#include <CLI/CLI.hpp>\n", "only in main.cpp, commands/command_line*"),
    ("solver/commands/a.cpp", "#include <CLI/CLI.hpp>\n", "only in main.cpp, commands/command_line*"),
    ("solver/model/a.cpp", '#include "simulation/run.hpp"\n', "model must not include"),
    ("solver/simulation/a.cpp", '#include "commands/check_report.hpp"\n', "simulation must not include"),
    ("solver/simulation/a.cpp", "#include <fmt/core.h>\n", "only in base/log.cpp"),
    ("solver/output/a.cpp", "#include <vtkCellArray.h>\n", "not in the table"),
    ("solver/mesh/a.cpp", "#include <boost/graph.hpp>\n", "not in the table"),
    ("catalyst/a.cpp", '#include "output/frames/frame.hpp"\n', "catalyst must not include output/frames/frame.hpp"),
    ("catalyst/a.hpp", '#include "solver/base/error.hpp"\n', "catalyst must not include solver/base/error.hpp"),
    ("catalyst/a.cpp", "#include <fmt/format.h>\n", "catalyst must not include fmt/format.h"),
    ("catalyst/a.cpp", "#include <hdf5.h>\n", "catalyst must not include hdf5.h"),
    ("solver/run_folder/a.hpp", '#include "case/case.hpp"\n', "run_folder must not include case/case.hpp"),
    ("solver/run_folder/a.hpp", '#include "base/error.hpp"\n', "must not include base/error.hpp"),
    ("solver/run_folder/a.hpp", "#include <mpi.h>\n", "only in parallel/"),
    ("solver/run_folder/history.hpp", "#include <nlohmann/json.hpp>\n", "only in output/*.cpp"),
    ("solver/run_folder/a.cpp", "\n", "header only"),
    ("solver/system/open_regular.hpp", '#include "base/error.hpp"\n', "must not include base/error.hpp"),
    ("solver/physics/a.cpp", '#include "run_folder/history.hpp"\n', "physics must not include"),
    ("catalyst/a.cpp", '#include "system/atomic_file.hpp"\n', "catalyst must not include system/atomic_file.hpp"),
    ("plugins/a.cxx", '#include "output/folder/run_folder.hpp"\n', "plugins must not include output/folder/run_folder.hpp"),
    ("plugins/a.h", "#include <mpi.h>\n", "plugins must not include mpi.h"),
    ("gui/widgets/a.cpp", '#include "run_folder/status.hpp"\n', "gui/widgets must not include"),
    ("gui/core/a.cpp", "#include <QPushButton>\n", "gui/core has no widget"),
    ("gui/core/a.cpp", "#include <vtkActor.h>\n", "gui/core must not include vtkActor.h"),
    ("gui/core/a.cpp", '#include "model/model.hpp"\n', "gui/core must not include model/model.hpp"),
    ("gui/render/a.cpp", "#include <QString>\n", "gui/render must not include QString"),
    ("gui/widgets/a.cpp", '#include "physics/sweep.hpp"\n', "gui/widgets must not include physics/sweep.hpp"),
    ("solver/utils/a.cpp", "\n", "folder solver/utils"),
    ("solver/other.cpp", "\n", "only main.cpp stands at the top"),
    ("solver/mesh/a.cpp", "\n" * (MAX_LINES + 1), "split it"),
    ("tests/unit/a_test.cpp", "\n" * (MAX_LINES + 1), "split it"),
    ("solver/mesh/a.cpp", "// TO" "DO later\n", "left in the source"),
    ("solver/mesh/a.hpp", "/" * (MAX_COLUMNS + 1) + "\n", "columns"),
    ("meshes/a.py", "# FIX" "ME\n", "left in the source"),
]


def plant(folder, files):
    for name, content in files.items():
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")


class Layering(unittest.TestCase):
    def test_a_clean_tree_has_no_violations(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, CLEAN)
            self.assertEqual(problems(folder), [])

    def test_each_planted_violation_is_found_and_nothing_else(self):
        for file, content, message in VIOLATIONS:
            with self.subTest(file=file, message=message), tempfile.TemporaryDirectory() as folder:
                plant(folder, CLEAN)
                plant(folder, {file: content})
                found = problems(folder)
                self.assertEqual(len(found), 1, found)
                self.assertIn(message, found[0])
                self.assertTrue(found[0].startswith(file + ":"), found[0])

    def test_a_file_of_exactly_the_limit_passes(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, {**CLEAN, "solver/mesh/a.cpp": ("/" * MAX_COLUMNS + "\n") * MAX_LINES})
            self.assertEqual(problems(folder), [])

    def test_words_that_merely_contain_a_mark_are_not_left_open(self):
        self.assertIsNone(LEFT_OPEN.search("mastodon hackney todoist"))


if __name__ == "__main__":
    unittest.main()
