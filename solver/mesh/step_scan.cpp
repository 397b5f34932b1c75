#include "mesh/step_scan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "base/error.hpp"
#include "mesh/file_input.hpp"

namespace breccia {
namespace {

struct Numbered {
  std::int64_t number;
  int line;
  std::int64_t owner;  ///< instance that it stands in
};

class StepReader {
 public:
  explicit StepReader(const std::filesystem::path& file) : file_(file.string()), in_(file) {}

  StepScan scan() {
    for (int c = in_.get(); c >= 0; c = in_.get()) {
      if (c == '\'') {
        skip_text();
      } else if (c == '/' && in_.peek() == '*') {
        skip_comment();
      } else if (c == '#') {
        read_number();
      } else if (c == ';') {
        owner_ = 0;
        begins_ = true;
      } else if (std::isalpha(c) != 0) {
        read_word(c);
      } else if (c > ' ' && c != '=') {
        begins_ = false;
      }
    }
    report_missing();
    report_repeated();
    return std::move(result_);
  }

 private:
  /// 'It''s': a quote within is doubled, so that two texts follow each other.
  void skip_text() {
    begins_ = false;
    for (int c = in_.get(); c >= 0 && c != '\'';) c = in_.get();
  }
  void skip_comment() {
    in_.get();
    for (int c = in_.get(); c >= 0; c = in_.get())
      if (c == '*' && in_.peek() == '/') {
        in_.get();
        return;
      }
  }
  void read_number() {
    constexpr std::int64_t kLargestName = 1'000'000'000'000'000;
    std::int64_t number = 0;
    while (std::isdigit(in_.peek()) != 0 && number < kLargestName) number = 10 * number + (in_.get() - '0');
    if (begins_) {
      defined_.push_back({number, in_.line(), number});
      owner_ = number;
    } else {
      used_.push_back({number, in_.line(), owner_});
    }
    begins_ = false;
  }
  void read_word(int first) {
    std::string word(1, static_cast<char>(first));
    while (std::isalnum(in_.peek()) != 0 || in_.peek() == '_' || in_.peek() == '-')
      word.push_back(static_cast<char>(in_.get()));
    begins_ = false;
    constexpr std::array kSolids{"MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS", "FACETED_BREP"};
    if (owner_ != 0 && std::any_of(kSolids.begin(), kSolids.end(), [&](const char* solid) { return word == solid; }))
      solids_.push_back(owner_);
  }

  void report_missing() {
    const auto by_number = [](const Numbered& a, const Numbered& b) { return a.number < b.number; };
    std::sort(defined_.begin(), defined_.end(), by_number);
    for (const Numbered& used : used_) {
      if (result_.problems.size() == kProblemsNamed) return;
      if (std::binary_search(defined_.begin(), defined_.end(), used, by_number)) continue;
      const std::string number = "#" + std::to_string(used.number);
      result_.problems.push_back({file_, used.line, "#" + std::to_string(used.owner),
                                  "refers to " + number + ", which the file does not have: the file is damaged",
                                  "a whole file: save it again in the program that it comes from", ""});
    }
    // An instance of several types, as (A() B()), is one solid.
    std::sort(solids_.begin(), solids_.end());
    result_.solids = std::unique(solids_.begin(), solids_.end()) - solids_.begin();
  }
  void report_repeated() {
    for (std::size_t i = 1; i < defined_.size() && result_.problems.size() < kProblemsNamed; ++i)
      if (defined_[i].number == defined_[i - 1].number)
        result_.problems.push_back({file_, std::max(defined_[i].line, defined_[i - 1].line),
                                    "#" + std::to_string(defined_[i].number), "is given twice: the file is damaged",
                                    "a whole file: save it again in the program that it comes from", ""});
  }

  std::string file_;
  FileInput in_;
  bool begins_ = true;      ///< an instance may begin here
  std::int64_t owner_ = 0;  ///< number of the instance that is read, 0: none
  std::vector<Numbered> defined_, used_;
  std::vector<std::int64_t> solids_;
  StepScan result_;
};

}  // namespace

StepScan scan_step(const std::filesystem::path& file) { return StepReader(file).scan(); }

}  // namespace breccia
