// An elastic sphere above a plate that is held: fine elements where they touch. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  radius = 0.010,
  gap = 2e-6,
  h = 0.0003,           // element size of the sphere at the contact
  h_far = 0.002,        // and at its far side
  fine = 0.0015,        // radius about the contact within which h holds
  plate_side = 0.010,
  plate_height = 0.002,
  h_plate = 0.001
];

Sphere(1) = {0, 0, radius + gap, radius};
Box(2) = {-plate_side/2, -plate_side/2, -plate_height, plate_side, plate_side, plate_height};

Physical Volume("sphere") = {1};
Physical Volume("plate") = {2};
Physical Surface("sphere_surface") = Abs(Boundary{ Volume{1}; });

// Fine about the contact, growing with the distance from it; the plate is uniform.
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Max(0, Sqrt(x*x + y*y + z*z) - %g)", h, (h_far - h) / (2 * radius - fine), fine);
Field[2] = Box;
Field[2].XMin = -plate_side; Field[2].XMax = plate_side; Field[2].YMin = -plate_side; Field[2].YMax = plate_side;
Field[2].ZMin = -2 * plate_height; Field[2].ZMax = gap / 2;
Field[2].VIn = h_plate; Field[2].VOut = 0;
Field[3] = Max;
Field[3].FieldsList = {1, 2};
Background Field = 3;

Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthFromCurvature = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;
