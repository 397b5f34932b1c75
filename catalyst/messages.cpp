#include "catalyst/messages.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <regex>

#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

constexpr std::size_t kMostText = 2000;  // of a flood of errors the first ones tell most

std::string errors;

/// "ERROR: In file.cxx, line 12\nvtkName (0x55d0): what" -> "vtkName: what".
std::string shortened(const std::string& text) {
  static const std::regex place(R"(^(ERROR: )?In [^ ]+, line \d+ )");
  static const std::regex address(R"( \(0x[0-9a-f]+\):)");
  return std::regex_replace(std::regex_replace(one_line(text), place, ""), address, ":");
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
    if (errors.size() > kMostText) return;
    if (!errors.empty()) errors += "; ";
    errors += shortened(text);
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

 protected:
  KeepErrors() = default;
  ~KeepErrors() override = default;
};
vtkStandardNewMacro(KeepErrors);

}  // namespace

void capture_messages() {
  // Errors reach us through the window below. Not VERBOSITY_OFF: that makes ParaView's Python log everything, and fail over it.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);
  vtkNew<KeepErrors> window;
  vtkOutputWindow::SetInstance(window);
}

std::string take_errors() { return std::exchange(errors, {}); }

}  // namespace breccia::insitu
