// A block on a floor; the sizes of both meshes are parameters.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.01, floor_h = 0.04 ];
Box(1) = {0, -0.01, 1e-8, 0.04, 0.04, 0.02};
Box(2) = {-0.04, -0.03, -0.02, 0.28, 0.08, 0.02};
Physical Volume("block") = {1};
Physical Volume("floor") = {2};
MeshSize{ PointsOf{ Volume{1}; } } = h;
MeshSize{ PointsOf{ Volume{2}; } } = floor_h;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
