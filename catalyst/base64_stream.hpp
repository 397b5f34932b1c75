#pragma once

#include <vtkBase64Utilities.h>
#include <vtkOutputStream.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace breccia::insitu {

/// What vtkBase64OutputStream writes, but in one piece: that one hands every four characters to the stream by
/// themselves, which took half of the time of a large file.
class Base64Stream : public vtkOutputStream {
 public:
  vtkTypeMacro(Base64Stream, vtkOutputStream) static Base64Stream* New();

  int StartWriting() override {
    bytes_.clear();
    return 1;
  }
  int Write(const void* data, std::size_t length) override {
    const auto* first = static_cast<const unsigned char*>(data);
    bytes_.insert(bytes_.end(), first, first + length);
    return 1;
  }
  int EndWriting() override {
    text_.resize((bytes_.size() + 2) / 3 * 4);
    const auto length = vtkBase64Utilities::Encode(bytes_.data(), static_cast<unsigned long>(bytes_.size()),
                                                   reinterpret_cast<unsigned char*>(text_.data()));
    return WriteStream(text_.data(), length);
  }

 protected:
  Base64Stream() = default;
  ~Base64Stream() override = default;

 private:
  std::vector<unsigned char> bytes_;
  std::string text_;
};

/// A writer of VTK's XML formats that uses it.
template <class Writer>
class WithBase64Stream : public Writer {
 public:
  static WithBase64Stream* New() {
    auto* writer = new WithBase64Stream;
    writer->InitializeObjectBase();
    return writer;
  }

 protected:
  WithBase64Stream() {
    const auto stream = vtkSmartPointer<Base64Stream>::New();
    this->SetDataStream(stream);
  }
};

}  // namespace breccia::insitu
