#pragma once

#include <array>

#include "case/insitu_fields.hpp"
#include "case/schema_ranges.hpp"

/// The rows of the table of keys for how a case is run and what is written, and for functions of time.
namespace breccia::case_ {

using namespace ranges;
using enum ValueType;
using enum Level;

// Packed by hand: with a line a field the table could not be read.
// clang-format off
inline constexpr auto run_keys = std::to_array<Key>({
    {.path = "detection", .type = section,
     .help = "Search for pairs of points and elements that may be in contact. It affects the speed, not the results."},
    {.path = "detection.algorithm", .type = choice, .fallback = "packed_tree",
     .choices = "ms|ms_slices|sorted_grid|packed_tree|brute_force",
     .help = "ms: the MS-tree and MS-search; ms_slices: the same one slice at a time; sorted_grid: a sorted grid; "
             "packed_tree: a packed tree, the fastest for different sizes or a poor order in memory; brute_force: all "
             "against all.", .example = "\"ms\""},
    {.path = "detection.buffer", .type = number, .unit = "m", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Distance by which boxes are enlarged, so that one search serves several steps. auto: a share of the "
             "element size. The least value in use is a tenth of the mean size of the elements that can be touched.",
     .example = "\"0.5 mm\""},
    {.path = "detection.cell", .type = number, .unit = "m", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Edge of a cell of ms, ms_slices and sorted_grid; the others have none. auto: from buffer and element "
             "size.", .example = "\"5 mm\""},
    {.path = "detection.verify", .type = boolean, .fallback = "false",
     .help = "Compare every step with a search of all against all; slow.", .example = "true"},

    {.path = "domains", .type = section,
     .help = "Division of the model over the ranks of a run (mpiexec -n N). It affects the speed, not the results."},
    {.path = "domains.kind", .type = choice, .fallback = "rcb", .choices = "rcb|grid",
     .help = "rcb: recursive coordinate bisection with equal work on all ranks; grid: equal cuboids. A small fragment "
             "belongs to one domain as a whole.", .example = "\"grid\""},
    {.path = "domains.n", .type = integers_or_one, .fallback = "[0, 0, 0]", .range = at_most_100000,
     .help = "Cuboids of the grid along x, y and z, as many as ranks; 0: chosen for the smallest cut area.",
     .example = "[2, 2, 1]"},
    {.path = "domains.exchange", .type = choice, .fallback = "non_blocking", .choices = "non_blocking|pairwise",
     .help = "non_blocking: a rank sends to all its neighbours at once; pairwise: one pair of ranks after the other, "
             "by a schedule without chains of waiting ranks.", .example = "\"pairwise\""},
    {.path = "domains.rebalance", .type = boolean, .fallback = "true",
     .help = "Divide the model again when the accumulated waiting time of the ranks exceeds the cost of a new "
             "division.", .example = "false"},
    {.path = "domains.margin", .type = number, .fallback = "1", .range = {.lower = 0.1, .upper = 100},
     .help = "Width of the halo of a domain in mean longest edges of the elements. Larger: fewer new divisions while "
             "bodies move, but more to search. Breccia enlarges it up to fivefold for fast bodies.", .example = "2"},
    {.path = "domains.patience", .type = number, .unit = "s", .fallback = "300", .range = positive,
     .help = "Wall time that a rank waits for others before a warning names them and the place; after twice this time "
             "the run ends. An in-situ script that takes so long is interrupted and switched off.",
     .example = "\"20 min\""},

    {.path = "checkpoint", .type = section,
     .help = "When the whole state is written to RUN/checkpoints, from which `breccia resume` continues. A checkpoint "
             "is also written at the end of every stage and of the run, and when a signal or command ends the run."},
    {.path = "checkpoint.steps", .type = integer, .fallback = "0", .range = steps,
     .help = "Steps between checkpoints; 0: not by steps.", .example = "10000"},
    {.path = "checkpoint.interval", .type = number, .unit = "s", .fallback = "0", .range = not_negative,
     .help = "Simulated time between checkpoints; 0: not by simulated time.", .example = "\"1 ms\""},
    {.path = "checkpoint.wall_interval", .level = basic, .type = number, .unit = "s", .fallback = "300",
     .range = not_negative,
     .help = "Wall time between checkpoints; 0: not by wall time.", .example = "\"10 min\""},
    {.path = "checkpoint.keep", .type = integer, .fallback = "2", .range = at_most_100000,
     .help = "Number of checkpoints to keep, in addition to the last sound one; 0: none are written.", .example = "5"},

    {.path = "output", .type = section, .help = "Results that a run writes, and their intervals."},
    {.path = "output.frame_interval", .level = basic, .type = number, .unit = "s", .fallback = "0",
     .range = not_negative,
     .help = "Simulated time between frames for ParaView; 0: only the last state.", .example = "\"1 us\""},
    {.path = "output.history_interval", .level = basic, .type = number, .unit = "s", .fallback = "auto",
     .range = positive,
     .word = "auto",
     .help = "Simulated time between lines of the history. auto: 500 lines a run, but no more than one in 20 steps.",
     .example = "\"100 ns\""},
    {.path = "output.elements", .type = boolean, .fallback = "true", .help = "Elements in frames.", .example = "false"},
    {.path = "output.joints", .type = boolean, .fallback = "true", .help = "Joints in frames.", .example = "false"},
    {.path = "output.contacts", .type = boolean, .fallback = "true", .help = "Contact points in frames.",
     .example = "false"},
    {.path = "output.gauges", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Groups, or bodies as \"body 3\" (frames show their numbers), for which the history records reaction, "
             "contact force, displacement, velocity, centre of mass, momentum, spin, resultant force and torque. Means "
             "are weighted by mass. The reaction is the force of the constraints on the group, inertia of the "
             "constrained nodes included: under a press that moves down it points down. Velocity, momentum and spin "
             "are half a step later than the other columns.", .example = "[\"support\", \"body 0\"]"},

    {.path = "gauge[]", .type = section_list,
     .help = "Columns of the history: values at points of the material, along a line, between two points, or of cracks "
             "that reach a group. Positions are those at rest; the element there is followed. In conditions a column "
             "is named as NAME.elongation."},
    {.path = "gauge[].name", .level = basic, .type = text, .required = true,
     .help = "Begins the names of the columns. Letters, digits, spaces and the signs . _ - are allowed.",
     .example = "\"cmod\""},
    {.path = "gauge[].kind", .level = basic, .type = choice, .required = true,
     .choices = "point|line|extensometer|cracks",
     .help = "point: displacement, velocity (half a step later) and Cauchy stress of the element at a point. line: the "
             "same at points from one end to the other. extensometer: change of the distance of two points, as a "
             "length and a strain; across a notch it is the crack mouth opening. cracks: number of broken joints that "
             "touch a group.", .example = "\"extensometer\""},
    {.path = "gauge[].at", .level = basic, .type = vector, .unit = "m", .help = "Position of a point.",
     .example = "[0, \"10 mm\", 0]"},
    {.path = "gauge[].from", .level = basic, .type = vector, .unit = "m",
     .help = "First point of a line or extensometer. Where several elements meet, the one with the lowest number holds "
             "it.", .example = "[\"-5 mm\", 0, 0]"},
    {.path = "gauge[].to", .level = basic, .type = vector, .unit = "m",
     .help = "Last point of a line or extensometer.", .example = "[\"5 mm\", 0, 0]"},
    {.path = "gauge[].points", .type = integer, .fallback = "2", .range = points_of_line,
     .help = "Number of points of a line, both ends included.", .example = "11"},
    {.path = "gauge[].group", .type = text, .help = "Surface, curve, point or element set that cracks reach.",
     .example = "\"support\""},

    {.path = "trigger[]", .type = section_list,
     .help = "An action that is carried out when a condition over columns of the history becomes true. The condition "
             "is evaluated at every line of the history."},
    {.path = "trigger[].when", .type = text, .required = true,
     .help = "Comparisons (< <= > >=) of columns, numbers with or without a unit, + - * /, abs(), peak() and lowest() "
             "(largest and smallest value so far), joined by and, or; `CONDITION for 2 ms` holds after that time. "
             "Columns are named as in history.csv without the unit: broken_joints, plate.reaction_z; other names in "
             "single quotes: 'plate reaction z'.", .example = "\"broken_joints > 100\""},
    {.path = "trigger[].action", .type = choice, .required = true,
     .choices = "frame|checkpoint|extract|stop",
     .help = "frame, checkpoint: write one; extract: execute the pipelines of [insitu]; stop: end the run.",
     .example = "\"frame\""},
    {.path = "trigger[].once", .type = boolean, .fallback = "true",
     .help = "false: each time that the condition becomes true.", .example = "false"},

    {.path = "insitu", .type = section,
     .help = "Pictures, extracts and live views that ParaView Catalyst makes during the run (catalyst/README.md)."},
    {.path = "insitu.run", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Pipelines that are executed up to 50 times at equal intervals of simulated time: names as in "
             "insitu.pipeline.name, or scripts. Use [[insitu.pipeline]] for triggers or parameters.",
     .example = "[\"fractures\", \"stress\"]"},
    {.path = "insitu.max_overhead", .type = number, .fallback = "0.02", .range = {.lower = 0, .upper = 1,
     .lower_open = true},
     .help = "Largest share of the wall time for pipelines, start-up included. Each has an equal share plus unused "
             "parts of others; after two executions that measure its cost it runs at equal intervals. Executions by "
             "broken joints or wall time are skipped while the share is exceeded. Strict pipelines and "
             "insitu.least_instants may exceed it.", .example = "0.1"},
    {.path = "insitu.least_instants", .type = integer, .fallback = "20", .range = steps,
     .help = "Least number of executions of each pipeline of insitu.run (breccia run --insitu), regardless of the "
             "cost; 0: max_overhead decides.", .example = "50"},
    {.path = "insitu.on_error", .type = choice, .fallback = "warn", .choices = "warn|stop",
     .help = "When a pipeline fails: warn, and switch it off after three failures; or stop the run.",
     .example = "\"stop\""},

    {.path = "insitu.backend", .type = choice, .fallback = "auto", .choices = "auto|paraview|catalyst2",
     .help = "Program that executes the pipelines. paraview: the adaptor linked with ParaView; catalyst2: an "
             "implementation of Catalyst 2 found at run time, such as that of a newer ParaView, for scripts; auto: "
             "paraview if its adaptor can be loaded, else catalyst2. `breccia insitu info` lists what is available.",
     .example = "\"catalyst2\""},

    {.path = "insitu.live", .type = section,
     .help = "Live view of the run in ParaView: `breccia live`, or Catalyst > Connect there, before or during the run. "
             "`breccia run --live` adds this section."},
    {.path = "insitu.live.address", .type = text, .fallback = "\"localhost:22222\"",
     .help = "Address at which ParaView listens, host:port.", .example = "\"localhost:22333\""},
    {.path = "insitu.live.remote", .type = boolean, .fallback = "false",
     .help = "Permits an address on another machine; the data are sent without encryption or authentication.",
     .example = "true"},
    {.path = "insitu.live.interval", .type = number, .unit = "s", .fallback = "1", .range = not_negative,
     .help = "Least wall time between two updates.", .example = "\"0.2 s\""},
    {.path = "insitu.live.channels", .type = text_list,
     .fallback = "[\"surface\", \"fractures\", \"contacts\", \"domains\", \"elements\", \"history\"]",
     .choices = "elements|joints|fractures|contacts|surface|domains|history",
     .help = "Channels that are offered to ParaView.", .example = "[\"surface\", \"fractures\"]"},
    {.path = "insitu.live.max_overhead", .type = number, .fallback = "0.05",
     .range = {.lower = 0, .upper = 1, .lower_open = true},
     .help = "Largest share of the wall time for updates; beyond it they become less frequent.", .example = "0.5"},
    {.path = "insitu.live.fields", .type = text_list, .fallback = "[]", .choices = insitu_fields,
     .help = "Arrays that are offered; none: all. The view of `breccia live` colours by von_mises, time_of_failure and "
             "rank.", .example = "[\"von_mises\", \"time_of_failure\", \"rank\"]"},
    {.path = "insitu.live.region", .type = section,
     .help = "A box: cells with their centre outside are not offered."},
    {.path = "insitu.live.region.lower", .type = vector, .unit = "m", .required = true, .help = "Its lower corner.",
     .example = "[0, 0, 0]"},
    {.path = "insitu.live.region.upper", .type = vector, .unit = "m", .required = true, .help = "Its upper corner.",
     .example = "[\"10 mm\", \"10 mm\", \"1 mm\"]"},

    {.path = "insitu.pipeline[]", .type = section_list,
     .help = "A pipeline that processes the state during the run, at each of its triggers; without any, up to 50 times "
             "over the simulated time."},
    {.path = "insitu.pipeline[].name", .type = text, .required = true,
     .choices = "volume|joints|fractures|contacts|surface|domains|history|probes|"
                "fracture_growth|stress|ranks|contact_forces",
     .help = "volume, joints, fractures, contacts, surface, domains and history record data; probes records fields "
             "at points; fracture_growth, stress, ranks and contact_forces draw pictures; a name that ends with "
             ".py is a script exported from ParaView, relative to the case file.",
     .example = "\"fractures\""},
    {.path = "insitu.pipeline[].every_steps", .type = integer, .fallback = "0", .range = steps,
     .help = "Trigger: number of steps between executions; 0: none.", .example = "100"},
    {.path = "insitu.pipeline[].every_time", .type = number, .unit = "s", .fallback = "0", .range = not_negative,
     .help = "Trigger: simulated time between executions; 0: none.", .example = "\"1 us\""},
    {.path = "insitu.pipeline[].every_wall", .type = number, .unit = "s", .fallback = "0", .range = not_negative,
     .help = "Trigger: wall time between executions; 0: none.", .example = "\"30 s\""},
    {.path = "insitu.pipeline[].every_broken", .type = integer, .fallback = "0", .range = steps,
     .help = "Trigger: number of newly broken joints between executions; 0: none.", .example = "50"},
    {.path = "insitu.pipeline[].first_break", .type = boolean, .fallback = "false",
     .help = "Trigger: the first joint breaks.",
     .example = "true"},
    {.path = "insitu.pipeline[].strict", .type = boolean, .fallback = "false",
     .help = "Execute at every trigger, regardless of the cost.", .example = "true"},
    {.path = "insitu.pipeline[].least_instants", .type = integer, .fallback = "0", .range = steps,
     .help = "Least number of executions over the simulated time, regardless of the cost.", .example = "20"},
    {.path = "insitu.pipeline[].parameters", .type = settings, .fallback = "{}",
     .help = "Parameters of the pipeline: width, height, azimuth, elevation, zoom, lower, upper and title for "
             "pictures; any numbers, in SI or with a unit, and texts for scripts. A script that requests a text gets "
             "it unchanged.", .example = "{ width = 1280, title = \"plate\" }"},
    {.path = "insitu.pipeline[].fields", .type = text_list, .fallback = "[]", .choices = insitu_fields,
     .help = "Arrays that recordings, probes and your scripts receive; none: all.", .example = "[\"id\", \"stress\"]"},
    {.path = "insitu.pipeline[].region", .type = section,
     .help = "A box: cells with their present centre outside are not passed to the pipeline."},
    {.path = "insitu.pipeline[].region.lower", .type = vector, .unit = "m", .required = true,
     .help = "Its lower corner.", .example = "[0, 0, 0]"},
    {.path = "insitu.pipeline[].region.upper", .type = vector, .unit = "m", .required = true,
     .help = "Its upper corner.", .example = "[\"10 mm\", \"10 mm\", \"1 mm\"]"},
    {.path = "insitu.pipeline[].probe[]", .type = section_list,
     .help = "Points at which the pipeline probes records fields: one point, a line (along, points), or a plane "
             "(across and rows too). The points are fixed in space; values are those of the element at the point."},
    {.path = "insitu.pipeline[].probe[].name", .type = text, .required = true,
     .help = "The file is extracts/probes/NAME.csv.", .example = "\"tip\""},
    {.path = "insitu.pipeline[].probe[].at", .type = vector, .unit = "m", .required = true,
     .help = "The point, the start of the line, or a corner of the plane.", .example = "[0, 0, \"1 mm\"]"},
    {.path = "insitu.pipeline[].probe[].along", .type = vector, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "Vector from there to the last point of the line.", .example = "[\"10 mm\", 0, 0]"},
    {.path = "insitu.pipeline[].probe[].points", .type = integer, .fallback = "1", .range = at_most_10000_points,
     .help = "Number of points, both ends included.", .example = "11"},
    {.path = "insitu.pipeline[].probe[].across", .type = vector, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "Vector from the first row of points to the last one.", .example = "[0, \"10 mm\", 0]"},
    {.path = "insitu.pipeline[].probe[].rows", .type = integer, .fallback = "1", .range = at_most_10000_points,
     .help = "Number of rows, first and last included.", .example = "11"},

    {.path = "<function>", .type = notation,
     .help = "A function of time is a quantity, or a table of the keys below, which add up. Time counts from the start "
             "of the run."},
    {.path = "<function>.constant", .level = basic, .type = number, .unit = "*", .fallback = "0",
     .help = "Value at all times.",
     .example = "\"1 MPa\""},
    {.path = "<function>.linear", .level = basic, .type = number, .unit = "*/s", .fallback = "0",
     .help = "Rate of growth from 0 at time 0.", .example = "\"20 GPa/s\""},
    {.path = "<function>.table", .level = basic, .type = points, .unit = "*",
     .help = "Points [time, value], times increasing; linear between them, constant before the first and after the "
             "last.", .example = "[[0, 0], [\"1 ms\", \"1 mm\"]]"},

    {.path = "<function>.ramp[]", .type = section_list,
     .help = "Linear from one value to another, constant before and after. One table, or a list of them."},
    {.path = "<function>.ramp[].from", .level = basic, .type = number, .unit = "*", .fallback = "0",
     .help = "Value before.",
     .example = "0"},
    {.path = "<function>.ramp[].to", .level = basic, .type = number, .unit = "*", .required = true,
     .help = "Value after.",
     .example = "\"-9.81 m/s2\""},
    {.path = "<function>.ramp[].start", .level = basic, .type = number, .unit = "s", .fallback = "0",
     .help = "Time at which it starts.", .example = "0"},
    {.path = "<function>.ramp[].end", .level = basic, .type = number, .unit = "s", .required = true,
     .help = "Time at which it ends.",
     .example = "\"2.4 s\""},

    {.path = "<function>.csv[]", .type = section_list,
     .help = "Points from a text file of columns (CSV), linear between them, constant before the first and after the "
             "last; at most 100000 lines and 64 MiB. Columns are separated by semicolons, tabs, commas or blanks; "
             "numbers have decimal points; a header is optional; lines that begin with #, % or ! are ignored. The case "
             "in the run folder contains the points: a resumed run does not need the file. One table, or a list of "
             "them."},
    {.path = "<function>.csv[].file", .level = basic, .type = path, .required = true,
     .help = "The file, relative to the case file.",
     .example = "\"shake.csv\""},
    {.path = "<function>.csv[].time", .level = basic, .type = column, .fallback = "1",
     .help = "Column of the times, by its name in the header (without the unit) or by its number. Times increase.",
     .example = "\"t\""},
    {.path = "<function>.csv[].value", .level = basic, .type = column, .fallback = "2",
     .help = "Column of the values, by its name or number.", .example = "\"a_x\""},
    {.path = "<function>.csv[].time_unit", .type = text, .fallback = "\"\"",
     .help = "Unit of the times. Empty: that of the header, as in \"t [ms]\" or \"t (ms)\", or s.",
     .example = "\"ms\""},
    {.path = "<function>.csv[].value_unit", .type = text, .fallback = "\"\"",
     .help = "Unit of the values. Empty: that of the header, or the SI unit.", .example = "\"kPa\""},
    {.path = "<function>.csv[].scale", .type = number, .fallback = "1", .help = "Factor of the values.",
     .example = "-1"},
    {.path = "<function>.csv[].start", .type = number, .unit = "s", .fallback = "0",
     .help = "Time of the run at time 0 of the file.", .example = "\"2.4 s\""},

    {.path = "<function>.sine[]", .type = section_list,
     .help = "amplitude sin(2 pi frequency t + phase). One table, or a list of them."},
    {.path = "<function>.sine[].amplitude", .type = number, .unit = "*", .required = true, .help = "Its amplitude.",
     .example = "\"1 MPa\""},
    {.path = "<function>.sine[].frequency", .type = number, .unit = "1/s", .required = true, .range = not_negative,
     .help = "Its frequency.", .example = "\"10 Hz\""},
    {.path = "<function>.sine[].phase", .type = number, .unit = "rad", .fallback = "0", .help = "Its phase.",
     .example = "\"90 deg\""},
});
// clang-format on

}  // namespace breccia::case_
