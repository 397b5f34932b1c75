// Two arms bonded along y = 0 from the end of a notch on, in one layer of elements, in plane stress. Metres.
SetFactory("OpenCASCADE");

DefineConstant[
  length = 0.1,
  depth = 0.003,       // of an arm
  notch = 0.03,        // from the ends that are pulled
  thickness = 0.00075,
  h = 0.00075          // element size
];

Rectangle(1) = {0, -depth, 0, notch, depth};
Rectangle(2) = {notch, -depth, 0, length - notch, depth};
Rectangle(3) = {0, 0, 0, notch, depth};
Rectangle(4) = {notch, 0, 0, length - notch, depth};
BooleanFragments{ Surface{1:4}; Delete; }{}
Extrude {0, 0, thickness} { Surface{1:4}; Layers{1}; }

Physical Volume("lower") = {1, 2};
Physical Volume("upper") = {3, 4};

e = 1e-6;
Physical Surface("notch") = Surface In BoundingBox {-e, -e, -e, notch + e, e, thickness + e};
Physical Surface("end_lower") = Surface In BoundingBox {-e, -depth - e, -e, e, e, thickness + e};
Physical Surface("end_upper") = Surface In BoundingBox {-e, -e, -e, e, depth + e, thickness + e};

MeshSize{:} = h;
Mesh.Algorithm = 5;
Mesh.MaxNumThreads2D = 1;  // the mesh must not change with the machine
