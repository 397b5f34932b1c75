// A disc between two platens, flattened where they press: the Brazilian test. Its axis is z, the load along y. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  diameter = 0.050,
  thickness = 0.012,
  flat_angle = 20,      // degrees, which a flattened end takes of the circle
  platen_height = 0.006,
  gap = 1e-6,           // nothing touches at the start
  h = 0.0025,           // element size of the disc
  h_platen = 0.003
];

radius = diameter / 2;
half_height = radius * Cos(flat_angle / 2 * Pi / 180);
platen_width = 4 * radius * Sin(flat_angle / 2 * Pi / 180);

Cylinder(1) = {0, 0, -thickness/2, 0, 0, thickness, radius};
Box(2) = {-radius, -half_height, -thickness/2, diameter, 2 * half_height, thickness};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-platen_width/2, half_height + gap, -thickness/2, platen_width, platen_height, thickness};
Box(5) = {-platen_width/2, -half_height - gap - platen_height, -thickness/2, platen_width, platen_height, thickness};

Physical Volume("disc") = {3};
Physical Volume("upper") = {4};
Physical Volume("lower") = {5};

MeshSize{ PointsOf{ Volume{3}; } } = h;
MeshSize{ PointsOf{ Volume{4, 5}; } } = h_platen;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;      // the mesh must not change with the machine
