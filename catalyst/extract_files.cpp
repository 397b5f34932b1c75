#include "catalyst/extract_files.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLUtilities.h>

#include <cstdio>

#include "catalyst/base64_stream.hpp"
#include "catalyst/messages.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {

vtkStandardNewMacro(Base64Stream)

    namespace {
  namespace fs = std::filesystem;

  bool is_polygons(vtkDataObject * object) { return object->IsA("vtkPolyData") != 0; }

  const char* type_name(vtkDataArray * array) {
    switch (array->GetDataType()) {
      case VTK_DOUBLE:
        return "Float64";
      case VTK_INT:
        return "Int32";
      default:
        return "Int64";
    }
  }

  std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
      switch (c) {
        case '&':
          result += "&amp;";
          break;
        case '<':
          result += "&lt;";
          break;
        case '"':
          result += "&quot;";
          break;
        default:
          result += c;
      }
    }
    return result;
  }

  std::string array_lines(vtkDataSetAttributes * data) {
    std::string text;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
      vtkDataArray* array = data->GetArray(i);
      text += std::string("      <PDataArray type=\"") + type_name(array) + "\" Name=\"" + escaped(array->GetName()) +
              "\" NumberOfComponents=\"" + std::to_string(array->GetNumberOfComponents()) + "\"/>\n";
    }
    return text;
  }

  vtkSmartPointer<vtkXMLDataElement> parsed(const fs::path& file) {
    auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
    static_cast<void>(take_errors());
    if (!root) throw PipelineError(file.string() + ": is not an XML file, or cannot be read");
    return root;
  }

  template <class Reader>
  vtkSmartPointer<vtkDataObject> read_with(const fs::path& file) {
    vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    const std::string errors = take_errors();
    if (reader->GetErrorCode() != 0 || !errors.empty())
      throw PipelineError(file.string() +
                          ": cannot be read: " + (errors.empty() ? "not a complete file of VTK" : errors));
    return reader->GetOutputDataObject(0);
  }

}  // namespace

std::string summary_suffix(vtkDataObject* object) { return is_polygons(object) ? "pvtp" : "pvtu"; }

std::string instant_name(const std::string& channel, std::int64_t step) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "%09lld", static_cast<long long>(step));
  return channel + "_" + digits;
}

fs::path piece_name(vtkDataObject* object, const std::string& channel, std::int64_t step, int rank) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%04d", rank);
  return fs::path(instant_name(channel, step)) / (std::string(digits) + (is_polygons(object) ? ".vtp" : ".vtu"));
}

std::int64_t write_piece(vtkDataObject* object, const fs::path& file) {
  vtkSmartPointer<vtkXMLWriter> writer;
  if (is_polygons(object)) {
    writer = vtkSmartPointer<WithBase64Stream<vtkXMLPolyDataWriter>>::New();
  } else {
    writer = vtkSmartPointer<WithBase64Stream<vtkXMLUnstructuredGridWriter>>::New();
  }
  writer->SetInputDataObject(object);
  // As text first: VTK's own writing to a file that cannot grow has ended runs (a disk that is full).
  writer->WriteToOutputStringOn();
  // Not appended: what is appended can be read no more by ParaView 5.11 with Debian's libexpat since its security
  // update 2.5.0-1+deb12u2, https://gitlab.kitware.com/vtk/vtk/-/issues/19258.
  writer->SetDataModeToBinary();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToLZ4();
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == 0;
  const std::string errors = take_errors();
  if (!written || !errors.empty())
    throw PipelineError(file.string() + ": cannot be written: " + (errors.empty() ? "VTK refuses" : errors));
  return replace_file(file, writer->GetOutputString(), Sync::no);
}

std::string summary_text(vtkDataObject* object, const std::string& channel, std::int64_t step, int ranks) {
  const std::string type = is_polygons(object) ? "PPolyData" : "PUnstructuredGrid";
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
                     "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                     "compressor=\"vtkLZ4DataCompressor\">\n  <" +
                     type + " GhostLevel=\"0\">\n";
  auto* const set = vtkDataSet::SafeDownCast(object);
  if (set->GetPointData()->GetNumberOfArrays() > 0)
    text += "    <PPointData>\n" + array_lines(set->GetPointData()) + "    </PPointData>\n";
  text += "    <PCellData>\n" + array_lines(set->GetCellData()) +
          "    </PCellData>\n    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
          "NumberOfComponents=\"3\"/>\n    </PPoints>\n";
  for (int rank = 0; rank < ranks; ++rank)
    text += "    <Piece Source=\"" + escaped(piece_name(object, channel, step, rank).string()) + "\"/>\n";
  return text + "  </" + type + ">\n</VTKFile>\n";
}

std::string pvd_text(const std::vector<RecordedInstant>& instants) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const RecordedInstant& instant : instants)
    text += "    <DataSet timestep=\"" + exact(instant.time) + "\" group=\"\" part=\"0\" file=\"" +
            escaped(instant.file.string()) + "\"/>\n";
  return text + "  </Collection>\n</VTKFile>\n";
}

std::vector<RecordedInstant> read_pvd(const fs::path& file) {
  std::vector<RecordedInstant> instants;
  if (!fs::exists(file)) return instants;
  const auto root = parsed(file);
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw PipelineError(file.string() + ": has no <Collection>");
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    RecordedInstant instant;
    const char* name = entry->GetAttribute("file");
    if (name == nullptr || entry->GetScalarAttribute("timestep", instant.time) == 0)
      throw PipelineError(file.string() + ": an entry has no file or no timestep");
    instant.file = name;
    const std::string stem = instant.file.stem().string();
    // The step stands in the name of the file alone: channel_000000120.
    if (std::sscanf(stem.c_str() + stem.rfind('_') + 1, "%lld", reinterpret_cast<long long*>(&instant.step)) != 1)
      throw PipelineError(file.string() + ": the name " + instant.file.string() + " does not end with the step");
    instants.push_back(std::move(instant));
  }
  return instants;
}

std::vector<fs::path> read_summary(const fs::path& file) {
  const auto root = parsed(file);
  std::vector<fs::path> pieces;
  for (int i = 0; i < root->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* grid = root->GetNestedElement(i);
    for (int j = 0; j < grid->GetNumberOfNestedElements(); ++j) {
      vtkXMLDataElement* piece = grid->GetNestedElement(j);
      if (std::string(piece->GetName()) == "Piece" && piece->GetAttribute("Source") != nullptr)
        pieces.push_back(file.parent_path() / piece->GetAttribute("Source"));
    }
  }
  if (pieces.empty()) throw PipelineError(file.string() + ": lists no pieces");
  return pieces;
}

vtkSmartPointer<vtkDataObject> read_piece(const fs::path& file) {
  return file.extension() == ".vtp" ? read_with<vtkXMLPolyDataReader>(file)
                                    : read_with<vtkXMLUnstructuredGridReader>(file);
}

}  // namespace breccia::insitu
