#pragma once

#include <vtkBase64Utilities.h>
#include <vtkOutputStream.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace breccia::insitu {

/// What vtkBase64OutputStream writes, but in one piece, three bytes by two look-ups: that one writes every four
/// characters separately, which is slow for large files.
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
    const std::size_t whole = bytes_.size() / 3 * 3;
    char* to = text_.data();
    for (const unsigned char* from = bytes_.data(); from != bytes_.data() + whole; from += 3, to += 4) {
      std::memcpy(to, kPairs[std::size_t{from[0]} << 4 | from[1] >> 4].data(), 2);
      std::memcpy(to + 2, kPairs[(from[1] & 15U) << 8 | from[2]].data(), 2);
    }
    // What is left, with its padding.
    vtkBase64Utilities::Encode(bytes_.data() + whole, static_cast<unsigned long>(bytes_.size() - whole),
                               reinterpret_cast<unsigned char*>(to));
    return WriteStream(text_.data(), text_.size());
  }

 protected:
  Base64Stream() = default;
  ~Base64Stream() override = default;

 private:
  /// The two characters that stand for each value of twelve bits.
  static constexpr auto kPairs = [] {
    constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::array<char, 2>, 4096> pairs{};
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kAlphabet[i >> 6], kAlphabet[i & 63]};
    return pairs;
  }();

  std::vector<unsigned char> bytes_;
  std::string text_;
};

/// A writer of VTK's XML formats that uses it, and omits each array's range: readers need none, and computing them is
/// slow.
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

  void WriteArrayInline(vtkAbstractArray* array, vtkIndent indent, const char* name, int write_num_tuples) override {
    this->WriteArrayHeader(array, indent, name, write_num_tuples, 0);
    *this->Stream << ">\n";
    this->WriteInlineData(array, indent.GetNextIndent());
    this->WriteArrayFooter(*this->Stream, indent, array, 0);
  }
};

}  // namespace breccia::insitu
