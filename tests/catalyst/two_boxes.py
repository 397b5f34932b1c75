"""A case of two boxes side by side that fly about and break."""


def case(cells, strength, energy, end, more=""):
    """@param more  sections beside"""
    return f"""title = "two boxes"
[mesh.raster]
cells = {cells}
cell_size = "10 mm"
boxes = [2, 1, 1]
gap = ["1 mm", "0 mm", "0 mm"]
group = "box"
[[material]]
group = "box"
young = "4 MPa"
poisson = 0.3
density = "2340 kg/m3"
joints = "breakable"
[[joint]]
group = "box"
penalty_factor = 10
tensile_strength = "{strength}"
energy_mode_1 = "{energy}"
[[contact]]
between = ["*", "*"]
penalty = "40 MPa"
[[initial_velocity]]
group = "box"
random = ["1 m/s", "2 m/s"]
seed = 3
{more}[[stage]]
name = "fly"
end = "{end}"
"""
