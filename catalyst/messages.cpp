#include "catalyst/messages.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <regex>
#include <utility>

#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

std::string first_error;  // the others of an execution mostly follow from it
int further_errors = 0;
std::vector<std::string> warnings;
constexpr std::size_t kMostWarnings = 100;  // which differ; nobody may take them

/// "ERROR: In file.cxx, line 12\nvtkName (0x55d0): what" -> "vtkName: what"; the same of a warning.
std::string shortened(const std::string& text) {
  static const std::regex place(R"(^((ERROR|Warning|Generic Warning): )?In [^ ]+, line \d+ (\(nullptr\): )?)");
  static const std::regex address(R"( \(0x[0-9a-f]+\):)");
  return std::regex_replace(std::regex_replace(one_line(text), place, ""), address, ":");
}

void keep_warning(const char* text) {
  std::string line = shortened(text);
  if (warnings.size() < kMostWarnings && std::find(warnings.begin(), warnings.end(), line) == warnings.end())
    warnings.push_back(std::move(line));
}

class KeepErrors final : public vtkOutputWindow {
 public:
  static KeepErrors* New();
  vtkTypeMacro(KeepErrors, vtkOutputWindow) KeepErrors(const KeepErrors&) = delete;
  KeepErrors& operator=(const KeepErrors&) = delete;

  void DisplayText(const char* text) override {
    // What reaches us as plain text came through no severity: not an error.
    static_cast<void>(text);
  }
  void DisplayErrorText(const char* text) override {
    if (first_error.empty()) {
      first_error = shortened(text);
    } else {
      ++further_errors;
    }
  }
  void DisplayWarningText(const char* text) override { keep_warning(text); }
  void DisplayGenericWarningText(const char* text) override { keep_warning(text); }
  void DisplayDebugText(const char*) override {}

 protected:
  KeepErrors() = default;
  ~KeepErrors() override = default;
};
vtkStandardNewMacro(KeepErrors);

}  // namespace

void capture_messages() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // errors reach us through the window
  vtkNew<KeepErrors> window;
  vtkOutputWindow::SetInstance(window);
}

std::string take_errors() {
  const int further = std::exchange(further_errors, 0);
  std::string text = std::exchange(first_error, {});
  if (further > 0) text += " (and " + std::to_string(further) + " more)";
  return text;
}

std::vector<std::string> take_warnings() { return std::exchange(warnings, {}); }

}  // namespace breccia::insitu
