// A beam with a sawn notch on two rollers, a third presses on its middle: three-point bending.
// The beam lies along x, the load is along y. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  length = 0.100,
  span = 0.080,         // between the lower rollers
  depth = 0.020,
  thickness = 0.010,
  notch_depth = 0.008,
  notch_width = 0.001,
  roller = 0.003,       // radius, a prism of twelve sides, of which one lies on the beam
  gap = 1e-6,           // nothing touches at the start
  h = 0.002,            // element size above the notch
  h_far = 0.004,        // and at the ends of the beam
  h_roller = 0.0025
];

Box(1) = {-length/2, 0, -thickness/2, length, depth, thickness};
Box(2) = {-notch_width/2, -depth, -thickness/2, notch_width, depth + notch_depth, thickness};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

away = roller * Cos(Pi / 12) + gap;  // of a roller's axis from the face of the beam
axis_x[] = {-span/2, span/2, 0};
axis_y[] = {-away, -away, depth + away};
rollers[] = {};
For r In {0:2}
  p = newp;
  For i In {0:11}
    angle = (i + 0.5) * Pi / 6;
    Point(p + i) = {axis_x[r] + roller * Cos(angle), axis_y[r] + roller * Sin(angle), -thickness/2};
  EndFor
  l = newl;
  For i In {0:11}
    Line(l + i) = {p + i, p + (i + 1) % 12};
  EndFor
  loop = newll;
  Curve Loop(loop) = {l:(l + 11)};
  s = news;
  Plane Surface(s) = {loop};
  made[] = Extrude {0, 0, thickness} { Surface{s}; };
  rollers[] += made[1];
EndFor

Physical Volume("beam") = {3};
Physical Volume("left") = {rollers[0]};
Physical Volume("right") = {rollers[1]};
Physical Volume("press") = {rollers[2]};

// Fine where the crack runs, growing with the distance from there; the rollers are uniform. The greatest of the three counts.
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Max(0, Abs(x) - %g)", h, (h_far - h) / (length / 2 - depth / 4), depth / 4);
Field[2] = Box;
Field[2].XMin = -length; Field[2].XMax = length; Field[2].ZMin = -length; Field[2].ZMax = length;
Field[2].YMin = -length; Field[2].YMax = -gap / 2;
Field[2].VIn = h_roller; Field[2].VOut = 0;
Field[3] = Box;
Field[3].XMin = -length; Field[3].XMax = length; Field[3].ZMin = -length; Field[3].ZMax = length;
Field[3].YMin = depth + gap / 2; Field[3].YMax = length;
Field[3].VIn = h_roller; Field[3].VOut = 0;
Field[4] = Max;
Field[4].FieldsList = {1, 2, 3};
Background Field = 4;

Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthFromCurvature = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;      // the mesh must not change with the machine
