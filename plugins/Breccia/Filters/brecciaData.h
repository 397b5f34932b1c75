#ifndef brecciaData_h
#define brecciaData_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"

class vtkDataArray;
class vtkDataObject;
class vtkTable;

/// What the filters share: finding the parts of a run in their input, and sums and lists over the ranks. Lengths in m,
/// all quantities SI.
namespace breccia {

/// The input is incomplete; what() names the missing part, and the existing ones.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The processes that work on one data set. Everything is collective.
class Ranks {
 public:
  Ranks() : controller_(vtkMultiProcessController::GetGlobalController()) {}
  int Count() const { return controller_ ? controller_->GetNumberOfProcesses() : 1; }
  bool First() const { return !controller_ || controller_->GetLocalProcessId() == 0; }
  /// The lists of all ranks, one after another. @pre T is plain data
  template <class T>
  std::vector<T> Gather(const std::vector<T>& mine) const {
    std::vector<T> all(mine);
    if (Count() == 1) return all;
    const std::vector<char> bytes =
        GatherBytes(reinterpret_cast<const char*>(mine.data()), static_cast<vtkIdType>(mine.size() * sizeof(T)));
    all.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(all.data()), bytes.data(), bytes.size());
    return all;
  }
  /// Of each number the largest on any rank.
  void Largest(std::vector<double>& values) const;
  /// Throws BadInput on all ranks if `problem` is not empty on any: with the first one.
  void Agree(const std::string& problem) const;

 private:
  std::vector<char> GatherBytes(const char* mine, vtkIdType length) const;
  vtkMultiProcessController* controller_;
};

/// The data sets in an input.
std::vector<vtkDataSet*> Leaves(vtkDataObject* input);
/// The data set of a run's part that this rank has: the leaf, or the leaves appended, of `input` whose cells have the
/// array `mark`; null when there is none.
vtkSmartPointer<vtkDataSet> FindPart(vtkDataObject* input, const char* mark);
/// True where every data set in the input is known for another one than a block: it has another name, or it is no part
/// of a collection, and it has no cell array `mark`. Blocks without cells may lack their arrays.
bool LacksBlock(vtkDataObject* input, const char* name, const char* mark);
/// Names of the blocks and cell arrays in an input, for messages.
std::string Describe(vtkDataObject* input);

/// Cell array of a part that may be null or empty, which gives no values. Throws BadInput when cells lack the array,
/// or when it has another number of components.
std::vector<vtkTypeInt64> Integers(vtkDataSet* part, const char* name, int components = 1);
std::vector<double> Numbers(vtkDataSet* part, const char* name, int components = 1);
/// Corners of all cells, which must have `count` of them each.
std::vector<double> Corners(vtkDataSet* part, int count);

/// Tetrahedra: those of this rank.
struct Elements {
  vtkSmartPointer<vtkDataSet> grid;  ///< null: none here
  std::vector<vtkTypeInt64> id;
  std::vector<vtkTypeInt64> neighbour;  ///< (n, 4) across the face opposite to each corner, -1: none
  std::vector<double> corners;          ///< (n, 4, 3)
  vtkIdType Count() const { return static_cast<vtkIdType>(id.size()); }
};
/// Collective. Throws BadInput on all ranks when there are none on any.
Elements FindElements(vtkDataObject* input, const Ranks& ranks);

/// Failed joints: those of this rank.
struct Cracks {
  vtkSmartPointer<vtkDataSet> grid;  ///< all joints, failed or not
  std::vector<vtkIdType> cell;       ///< of the grid
  std::vector<vtkTypeInt64> id;      ///< 4 element + face
  std::vector<double> corners;       ///< (n, 3, 3)
  std::vector<double> time;          ///< s
  std::vector<vtkTypeInt64> mode;    ///< 1, 2, 3: mixed
  vtkIdType Count() const { return static_cast<vtkIdType>(id.size()); }
};
/// Reads `joints`, or, if that is null, `input`. Collective; throws as above.
Cracks FindCracks(vtkDataObject* input, vtkDataObject* joints, const Ranks& ranks);

/// Where elements stand in a list, by their ids.
class IdIndex {
 public:
  explicit IdIndex(const std::vector<vtkTypeInt64>& ids);
  /// -1: not in the list.
  vtkIdType Find(vtkTypeInt64 id) const;

 private:
  vtkTypeInt64 first_ = 0;
  std::vector<vtkIdType> place_;                            ///< dense, from first_
  std::vector<std::pair<vtkTypeInt64, vtkIdType>> sorted_;  ///< where ids are too far apart
};

/// Corners of the face opposite to corner `face` of a tetrahedron, outward sense.
inline constexpr int kFaceCorners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Adds a column. @param components  values are (rows, components)
void AddColumn(vtkTable* table, const char* name, const std::vector<double>& values, int components = 1);
void AddColumn(vtkTable* table, const char* name, const std::vector<vtkTypeInt64>& values);
/// Adds a number to the field data.
void AddFact(vtkDataObject* object, const char* name, double value);

}  // namespace breccia

#endif
