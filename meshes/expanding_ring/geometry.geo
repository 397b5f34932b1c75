// A thin ring around z in one layer of elements, in plane stress. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  radius = 0.5,     // of its middle line
  width = 0.02,     // along the radius
  thickness = 0.008,
  h = 0.008         // element size
];

Disk(1) = {0, 0, -thickness/2, radius + width/2};
Disk(2) = {0, 0, -thickness/2, radius - width/2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
slice[] = Extrude {0, 0, thickness} { Surface{3}; Layers{1}; };

Physical Volume("ring") = {slice[1]};

MeshSize{ : } = h;
Mesh.Algorithm = 5;
Mesh.MaxNumThreads2D = 1;  // the mesh must not change with the machine
