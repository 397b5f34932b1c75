// A cylinder between two platens: the uniaxial compression test. Its axis is y. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  diameter = 0.050,
  height = 0.100,
  platen_diameter = 0.060,
  platen_height = 0.010,
  gap = 1e-6,           // nothing touches at the start
  h = 0.005,            // element size of the cylinder
  h_platen = 0.005
];

Cylinder(1) = {0, 0, 0, 0, height, 0, diameter/2};
Cylinder(2) = {0, height + gap, 0, 0, platen_height, 0, platen_diameter/2};
Cylinder(3) = {0, -gap - platen_height, 0, 0, platen_height, 0, platen_diameter/2};

Physical Volume("cylinder") = {1};
Physical Volume("upper") = {2};
Physical Volume("lower") = {3};

MeshSize{ PointsOf{ Volume{1}; } } = h;
MeshSize{ PointsOf{ Volume{2, 3}; } } = h_platen;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;      // the mesh must not change with the machine
