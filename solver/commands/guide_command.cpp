#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "case/schema.hpp"
#include "commands/commands.hpp"
#include "commands/terminal.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Page of the guide for a section of the case; other topics are found by the names of pages.
struct PageOfSection {
  std::string_view section, page;
};
constexpr auto kPages = std::to_array<PageOfSection>({
    {"title", "01-first-run"},
    {"mesh", "02-geometry-and-mesh"},
    {"plane", "12-plane-models"},
    {"material", "03-materials-and-joints"},
    {"joint", "03-materials-and-joints"},
    {"joints", "03-materials-and-joints"},
    {"contact", "04-contact-and-friction"},
    {"contact_points", "04-contact-and-friction"},
    {"sphere", "04-contact-and-friction"},
    {"detection", "04-contact-and-friction"},
    {"initial_velocity", "05-loads-and-stages"},
    {"stage", "05-loads-and-stages"},
    {"start", "05-loads-and-stages"},
    {"function", "05-loads-and-stages"},
    {"time", "06-reading-check"},
    {"domains", "07-ranks-and-clusters"},
    {"checkpoint", "07-ranks-and-clusters"},
    {"output", "08-results"},
    {"insitu", "09-in-situ"},
});

/// Lower case, words apart by single hyphens: "Plane strain" is plane-strain, as files of pages are named.
std::string as_file_name(std::string_view topic) {
  std::string name;
  for (const unsigned char c : topic) {
    const bool letter = std::isalnum(c) != 0;
    if (letter) name += static_cast<char>(std::tolower(c));
    if (!letter && !name.empty() && name.back() != '-') name += '-';
  }
  if (name.ends_with('-')) name.pop_back();
  return name;
}

/// The first page, guide before theory before cases, in whose name a topic stands.
std::string page_named(const fs::path& root, const std::string& topic) {
  for (const char* folder : {"guide", "theory", "cases", "more", "reference"}) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(root / folder, error))
      if (entry.path().extension() == ".html") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return ("-" + as_file_name(name) + "-").find("-" + topic + "-") != std::string::npos;
    });
    if (found != names.end()) return std::string(folder) + "/" + *found + ".html";
  }
  return "";
}

/// A text within an address: every other character as %XX.
std::string escaped(std::string_view text, std::string_view kept) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const unsigned char c : text) {
    if (std::isalnum(c) != 0 || kept.find(static_cast<char>(c)) != std::string_view::npos)
      out += static_cast<char>(c);
    else
      (out += '%') += {kDigits[c >> 4U], kDigits[c & 15U]};
  }
  return out;
}

/// The heading of a key on the page of its section, named by its path with hyphens.
std::string reference_of(const case_::Key& key) {
  const std::string path = case_::plain_path(key.path);
  std::string anchor = path;
  std::replace_if(anchor.begin(), anchor.end(), [](char c) { return c == '.' || c == '_'; }, '-');
  return "reference/" + path.substr(0, path.find('.')) + ".html#" + anchor;
}

/// Page and anchor below `root` for a topic: a section, a key, words of a page's name; otherwise the search for it.
std::string page_of(const fs::path& root, const std::string& topic) {
  if (topic.empty()) return "index.html";
  const std::string path = case_::plain_path(topic);
  for (const PageOfSection& row : kPages)
    if (row.section == path) return "guide/" + std::string(row.page) + ".html";
  for (const case_::Key& key : case_::schema())
    if (!key.is_section() && case_::plain_path(key.path) == path) return reference_of(key);
  const std::string named = page_named(root, as_file_name(topic));
  return named.empty() ? "search.html?q=" + escaped(topic, "") : named;
}

/// The folder of the HTML pages beside this program, installed or built. Throws OutputError where there is none.
fs::path guide_folder() {
  std::error_code error;
  const fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  const fs::path installed = above / "share/doc/breccia/guide", built = above / "solver/manual/guide/html";
  for (const fs::path& folder : {built, installed})
    if (fs::exists(folder / "index.html", error)) return folder;
  throw OutputError(Problem{installed.string(), 0, "", "the guide is not installed as HTML",
                            "`./run guide` in the source folder, where its pages are in solver/manual; the "
                            "Debian package breccia brings it",
                            ""});
}

/// True where a desktop has been asked to open the address.
bool open_in_browser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  std::string program = "xdg-open", argument = address;
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  pid_t process = 0;
  return ::posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments.data(), ::environ) == 0;
}

}  // namespace

int guide_command(const GuideCommand& asked) {
  const fs::path folder = guide_folder();
  const std::string address = "file://" + escaped(folder.string(), "/._-~") + "/" + page_of(folder, asked.topic);
  print_lines(address + "\n");
  if (!asked.address_only) (void)open_in_browser(address);
  return 0;
}

}  // namespace breccia
