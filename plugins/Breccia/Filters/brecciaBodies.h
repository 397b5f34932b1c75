#ifndef brecciaBodies_h
#define brecciaBodies_h

#include <map>
#include <string>
#include <vector>

#include "brecciaData.h"

namespace breccia {

/// What users call the bodies of a run, from the field data of its elements, where the reader puts it.
class BodyNames {
 public:
  /// Of the elements in `input`; without names, as in a Catalyst pipeline, bodies are named by their numbers.
  explicit BodyNames(vtkDataObject* input);
  /// "body 12" where there is no name; empty for bodies below 0, which are none.
  std::string Of(vtkTypeInt64 body) const;

 private:
  std::vector<std::string> names_;
};

/// Adds them to the field data. Nothing is added where there are none.
void AddBodyNames(vtkDataObject* elements, const std::vector<std::string>& names);
/// Adds a column of the names of bodies.
void AddBodyColumn(vtkTable* table, const char* name, const BodyNames& names, const std::vector<vtkTypeInt64>& bodies);

/// By fragment, the body of its element of smallest id, after which the fragment is called. Empty where the elements
/// have no array "body". Collective.
/// @param fragment  (elements) what each is part of
std::map<vtkTypeInt64, vtkTypeInt64> BodiesOfFragments(const Elements& elements,
                                                       const std::vector<vtkTypeInt64>& fragment, const Ranks& ranks);

}  // namespace breccia

#endif
