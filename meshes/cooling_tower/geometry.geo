// Hyperboloid shell on a flat floor. Metres, z up, the front is where y < 0.
// Inner face of the wall: an upright ring beam, on it r(z) = r_throat sqrt(1 + ((z - z_throat) / c)^2), with the c that
// fits the ring below the throat and the top above it. It is swept about the axis in quarters, and the wall grows from
// it along the normal, one element thick.
DefineConstant[
  height = 120,
  r_foot = 46,
  r_throat = 27,
  z_throat = 90,
  r_top = 29,
  wall = 0.5,
  base = 5,            // height of the ring beam, whose front breaks
  h = 2.3,             // edge of an element
  floor_side = 200,
  floor_height = 2,
  h_floor = 20
];

c_low = (z_throat - base) / Sqrt((r_foot / r_throat)^2 - 1);
c_high = (height - z_throat) / Sqrt((r_top / r_throat)^2 - 1);

Macro Meridian  // from z_0 to z_1, as the curve `meridian` from point `lower` to point `upper`
  points[] = {lower};
  pieces = 12;
  For i In {1 : pieces}
    z = z_0 + i * (z_1 - z_0) / pieces;
    c = z < z_throat ? c_low : c_high;
    upper = newp;
    Point(upper) = {r_throat * Sqrt(1 + ((z - z_throat) / c)^2), 0, z, h};
    points[] += {upper};
  EndFor
  meridian = newc;
  Spline(meridian) = {points[]};
Return

foot = newp;
Point(foot) = {r_foot, 0, 0, h};
lower = newp;
Point(lower) = {r_foot, 0, base, h};
curve_base = newc;
Line(curve_base) = {foot, lower};
z_0 = base; z_1 = z_throat;
Call Meridian;
curve_low = meridian;
lower = upper; z_0 = z_throat; z_1 = height;
Call Meridian;
curve_high = meridian;

shell[] = {}; ring[] = {};
curves[] = {curve_base, curve_low, curve_high};
For q In {1 : 4}
  For k In {0 : 2}
    made[] = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Curve{curves[k]}; };
    curves[k] = made[0];
    If (k == 0)
      ring[] += {made[1]};
    Else
      shell[] += {made[1]};
    EndIf
  EndFor
EndFor

tower[] = {}; back[] = {}; front[] = {}; back_foot[] = {}; front_foot[] = {};
For s In {0 : #shell[] - 1}
  made[] = Extrude { Surface{shell[s]}; Layers{ {1}, {wall} }; };
  tower[] += {made[1]};
EndFor
For q In {0 : 3}
  made[] = Extrude { Surface{ring[q]}; Layers{ {1}, {wall} }; };
  If (q < 2)
    back[] += {made[1]};
    back_foot[] += {made[5]};
  Else
    front[] += {made[1]};
    front_foot[] += {made[5]};
  EndIf
EndFor

Point(newp) = {-floor_side / 2, -floor_side / 2, 0, h_floor};
edge[] = Extrude {floor_side, 0, 0} { Point{newp - 1}; Layers{floor_side / h_floor}; };
top[] = Extrude {0, floor_side, 0} { Curve{edge[1]}; Layers{floor_side / h_floor}; };
floor[] = Extrude {0, 0, -floor_height} { Surface{top[1]}; Layers{1}; };

Physical Volume("tower") = {tower[]};
Physical Volume("back") = {back[]};
Physical Volume("front") = {front[]};
Physical Volume("floor") = {floor[1]};
Physical Surface("back_foot") = {back_foot[]};
Physical Surface("front_foot") = {front_foot[]};
