// Glass plate in the x-z plane, struck from +y at its centre; four supports under its edges. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  side = 0.100,              // edge of the plate
  thickness = 0.005,
  h = 0.0019,                // element size under the projectile
  h_edge = h,                // and at the edge of the plate
  support_length = 0.080,
  support_width = 0.005,
  support_height = 0.004,
  h_support = 0.0022,
  tip = 0.0025,              // radius of the flat tip of the projectile, a prism of twelve sides with a conical nose
  shaft = 0.008,             // its radius
  nose_length = 0.004,
  shaft_length = 0.014,
  h_projectile = 0.003,
  gap = 2e-6                 // between the plate and what it will touch
];

Box(1) = {-side/2, -thickness, -side/2, side, thickness, side};

low = -thickness - gap - support_height;
Box(2) = {-support_length/2, low, -side/2, support_length, support_height, support_width};
Box(3) = {-support_length/2, low, side/2 - support_width, support_length, support_height, support_width};
Box(4) = {-side/2, low, -support_length/2, support_width, support_height, support_length};
Box(5) = {side/2 - support_width, low, -support_length/2, support_width, support_height, support_length};

// Rings of the projectile: its area is 3 r^2 at radius r, so its volume is that of the mesh, exactly.
radius[] = {tip, shaft, shaft};
level[] = {gap, gap + nose_length, gap + nose_length + shaft_length};
For ring In {0:2}
  For i In {0:11}
    angle = (i + 0.5) * Pi / 6;
    Point(1000 + 12 * ring + i) = {radius[ring] * Cos(angle), level[ring], radius[ring] * Sin(angle)};
  EndFor
  For i In {0:11}
    Line(1000 + 12 * ring + i) = {1000 + 12 * ring + i, 1000 + 12 * ring + (i + 1) % 12};
  EndFor
  Curve Loop(1000 + ring) = {(1000 + 12 * ring):(1011 + 12 * ring)};
EndFor
Plane Surface(1000) = {1000};
Plane Surface(1001) = {1002};
For ring In {0:1}
  For i In {0:11}
    Line(1100 + 12 * ring + i) = {1000 + 12 * ring + i, 1012 + 12 * ring + i};
  EndFor
  For i In {0:11}
    Curve Loop(1100 + 12 * ring + i) = {1000 + 12 * ring + i, 1100 + 12 * ring + (i + 1) % 12,
                                        -(1012 + 12 * ring + i), -(1100 + 12 * ring + i)};
    Plane Surface(1100 + 12 * ring + i) = {1100 + 12 * ring + i};
  EndFor
EndFor
Surface Loop(1000) = {1000, 1001, 1100:1123};
Volume(6) = {1000};

Physical Volume("glass") = {1};
Physical Volume("support") = {2:5};
Physical Volume("projectile") = {6};

// Sizes: the plate grows coarser away from the impact, what touches it is uniform. The greatest of the three counts.
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Sqrt(x*x + z*z)", h, 2 * (h_edge - h) / side);
Field[2] = Box;
Field[2].XMin = -side; Field[2].XMax = side; Field[2].ZMin = -side; Field[2].ZMax = side;
Field[2].YMin = -side; Field[2].YMax = -thickness - gap/2;
Field[2].VIn = h_support; Field[2].VOut = 0;
Field[3] = Box;
Field[3].XMin = -side; Field[3].XMax = side; Field[3].ZMin = -side; Field[3].ZMax = side;
Field[3].YMin = gap/2; Field[3].YMax = side;
Field[3].VIn = h_projectile; Field[3].VOut = 0;
Field[4] = Max;
Field[4].FieldsList = {1, 2, 3};
Background Field = 4;

Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthFromCurvature = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = 5;           // Delaunay: unlike the frontal one it lays no regular lattice for cracks to follow
Mesh.Algorithm3D = 1;        // Delaunay (HXT of gmsh 4.8 makes another mesh each time)
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.45;  // no slivers: the worst element sets the time step
Mesh.MaxNumThreads3D = 1;    // the mesh must not change with the machine
