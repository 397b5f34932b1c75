// Cross-shaped armour block, three bars through one another along x, y and z, above a flat floor. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  overall = 2.0,        // length of each bar
  width = 0.7,          // of its square section
  gap = 1e-3,           // under the lowest face
  floor_side = 1.2,
  floor_height = 0.4,
  h = 0.3,              // element size of the block
  h_floor = 0.2
];

Box(1) = {-overall/2, -width/2, gap + overall/2 - width/2, overall, width, width};
Box(2) = {-width/2, -overall/2, gap + overall/2 - width/2, width, overall, width};
Box(3) = {-width/2, -width/2, gap, width, width, overall};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Box(5) = {-floor_side/2, -floor_side/2, -floor_height, floor_side, floor_side, floor_height};

Physical Volume("block") = {4};
Physical Volume("floor") = {5};

MeshSize{ PointsOf{ Volume{4}; } } = h;
MeshSize{ PointsOf{ Volume{5}; } } = h_floor;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;
