#include "output/folder/folder_check.hpp"

#include <algorithm>
#include <cerrno>
#include <regex>
#include <system_error>

#include "output/folder/folder_tree.hpp"
#include "output/folder/run_lock.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

void refuse(const fs::path& path, const std::string& kind, const char* wanted) {
  Problem problem;
  problem.file = path.string();
  problem.what = kind + ", which is neither followed nor opened in the folder of a run";
  problem.allowed = wanted;
  throw OutputError(problem);
}

void demand_regular(const fs::path& path) {
  if (const std::string kind = unusual_kind(path); !kind.empty()) refuse(path, kind, "a regular file, or none");
}

void demand_folder(const fs::path& path) {
  if (const std::string kind = unusual_kind(path); !kind.empty())
    refuse(path, kind, "a folder in the run's own, or none; a link may lead to the run's folder as a whole");
}

}  // namespace

bool is_frame_file(const std::string& name) {
  static const std::regex pattern(R"(\.?(elements|joints|contacts)(_\d+\.vtkhdf|\.hdf\.series)(\.tmp)?)");
  return std::regex_match(name, pattern);
}

void demand_plain_folder(const RunFolder& run) {
  for (const fs::path& file : {run.provenance(), run.case_file(), run.history(), run.status(), run.bodies(),
                               run.summary(), run.summary_text(), run.extract_steps(), lock_file(run.root)})
    demand_regular(file);
  for (const fs::path& folder : {run.frames(), run.checkpoints(), run.extracts()}) demand_folder(folder);
  for (const fs::path& folder : {run.frames(), run.checkpoints()}) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (is_frame_file(name) || name.starts_with("step_")) demand_regular(entry->path());
    }
  }
}

void demand_plain_tree(const fs::path& folder) {
  demand_folder(folder);
  const Opened opened = open_folder_of(folder / "entry", Depth::subfolder);
  if (!opened && opened.error == ENOENT) return;
  if (!opened) throw output_error(folder, "cannot open this folder: " + opened.reason);
  walk_tree(opened.descriptor, folder, [](const TreeEntry& entry) {
    if (entry.kind == EntryKind::other) demand_regular(entry.path);
    return true;
  });
}

void refuse_inside(const fs::path& folder, const fs::path& above, const char* what) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(fs::absolute(folder, error), error),
                 outer = fs::weakly_canonical(fs::absolute(above, error), error);
  const auto parted = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  if (parted.first != outer.end()) return;
  throw OutputError(Problem{folder.string(), 0, "", what, "a folder outside " + above.string(), ""});
}

}  // namespace breccia
