// A block just in front of a wall, towards which it flies along -x. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  block_length = 0.06,  // along x
  block_side = 0.04,
  gap = 10e-6,          // nothing touches at the start
  wall_thickness = 0.01,
  wall_side = 0.06,
  h = 0.004,            // element size of the block
  h_wall = 0.01
];

Box(1) = {gap, -block_side/2, -block_side/2, block_length, block_side, block_side};
Box(2) = {-wall_thickness, -wall_side/2, -wall_side/2, wall_thickness, wall_side, wall_side};

Physical Volume("block") = {1};
Physical Volume("wall") = {2};

MeshSize{ PointsOf{ Volume{1}; } } = h;
MeshSize{ PointsOf{ Volume{2}; } } = h_wall;
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;  // the worst element sets the time step
Mesh.MaxNumThreads3D = 1;      // the mesh must not change with the machine
