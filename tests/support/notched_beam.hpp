#pragma once

namespace breccia::test {

/// Geometry of a beam of two halves with a notch between them, open from below; "foot" is the lower side of the right
/// half, which is not to be held with the flank of the notch above it once that is open.
constexpr const char* kNotchedBeam = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 0.5};
Box(2) = {1, 0, 0, 1, 0.5, 0.5};
Box(3) = {1, 0.5, 0, 1, 0.5, 0.5};
BooleanFragments{ Volume{1, 2, 3}; Delete; }{}
e = 0.01;
Physical Volume("beam") = Volume{:};
Physical Surface("notch") = Surface In BoundingBox{1 - e, -e, -e, 1 + e, 0.5 + e, 0.5 + e};
Physical Surface("foot") = Surface In BoundingBox{1 - e, -e, -e, 2 + e, e, 0.5 + e};
MeshSize{:} = 0.3;
)";

}  // namespace breccia::test
