// A quarter of a slab of rock with a circular core, which is excavated later: one layer for plane strain. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  radius = 1,      // of the opening
  side = 8,        // of the quarter of the slab
  h = 0.1,         // element size at the opening
  h_border = 0.6   // at the outer borders
];

thickness = 1.5 * h;
Rectangle(1) = {0, 0, 0, side, side};
Disk(2) = {0, 0, 0, radius};
BooleanIntersection(3) = { Surface{1}; }{ Surface{2}; Delete; };
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{3}; };
BooleanFragments{ Surface{3, 4}; Delete; }{}
layer() = Extrude {0, 0, thickness} { Surface{3, 4}; Layers{1}; };

eps = 1e-3;
Physical Volume("core") = Volume In BoundingBox {-eps, -eps, -eps, radius + eps, radius + eps, thickness + eps};
all() = Volume{:};
core() = Volume In BoundingBox {-eps, -eps, -eps, radius + eps, radius + eps, thickness + eps};
all() -= core();
Physical Volume("rock") = all();
Physical Surface("left") = Surface In BoundingBox {-eps, -eps, -eps, eps, side + eps, thickness + eps};
Physical Surface("bottom") = Surface In BoundingBox {-eps, -eps, -eps, side + eps, eps, thickness + eps};
Physical Surface("right") = Surface In BoundingBox {side - eps, -eps, -eps, side + eps, side + eps, thickness + eps};
Physical Surface("top") = Surface In BoundingBox {-eps, side - eps, -eps, side + eps, side + eps, thickness + eps};

MeshSize{:} = h_border;
MeshSize{ PointsOf{ Volume{core()}; } } = h;
Mesh.Algorithm = 5;
