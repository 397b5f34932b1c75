#ifndef BRECCIA_CATALYST_INSITU_ABI_H
#define BRECCIA_CATALYST_INSITU_ABI_H

/* The interface of the solver and an in-situ adaptor: plain arrays and C functions, no VTK, no MPI type. The solver
 * opens the adaptor with dlopen when a run needs it, and gets its functions from breccia_insitu_api(). There are
 * two, libraries with the same function: libbreccia_catalyst.so has ParaView linked, libbreccia_catalyst2.so passes the
 * channels to any installed implementation of Catalyst 2.
 *
 * All lengths in m, all quantities SI. Strings are UTF-8 and end with 0. Functions marked "collective" are called by
 * all ranks of the communicator, in the same order and with the same pipelines; data are those of the rank. No function
 * throws, ends the process, or changes the handlers of signals when it returns. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BRECCIA_INSITU_ABI_VERSION 8

/* The channels: frozen names, in this order everywhere. A set of channels is a mask of bits 1 << channel. */
enum {
  BRECCIA_ELEMENTS = 0, /* tetrahedra, four own points each: the full grid, meant for recorded volumes */
  BRECCIA_JOINTS,       /* triangles: joints with damage, those that have failed included */
  BRECCIA_FRACTURES,    /* triangles: failed joints only */
  BRECCIA_CONTACTS,     /* vertices: contact points that carry a force */
  BRECCIA_SURFACE,      /* triangles: free faces with the fields of their elements */
  BRECCIA_DOMAINS,      /* boxes (hexahedra): one a rank, around its elements */
  BRECCIA_HISTORY,      /* table, no points: a row of the history; on the first rank, empty on the others */
  BRECCIA_NUM_CHANNELS
};
#define BRECCIA_CHANNEL_NAMES \
  { "elements", "joints", "fractures", "contacts", "surface", "domains", "history" }

/* In a mask of channels: elements and surface with their values at points too, which cost more to make. */
#define BRECCIA_POINT_VALUES (UINT32_C(1) << 16)

enum { BRECCIA_F64 = 0, BRECCIA_I32, BRECCIA_I64 }; /* BrecciaArray.type */
enum {
  BRECCIA_TABLE = 0,
  BRECCIA_VERTEX = 1,
  BRECCIA_TRIANGLE = 5,
  BRECCIA_TETRAHEDRON = 10,
  BRECCIA_HEXAHEDRON = 12
}; /* BrecciaGrid.cell */

/* Values of the cells of a grid (rows of a table) or of its points, components of one after another: xyz; xx yy zz xy
 * yz xz. */
typedef struct {
  const char* name;
  int32_t type;
  int32_t components;
  const void* values; /* (num_cells or num_points, components); may be NULL when there are none */
} BrecciaArray;

/* A channel on this rank: only what the rank owns, so that each cell is on exactly one rank. Also a rank without cells
 * has all arrays, with their names, types and components. */
typedef struct {
  int32_t cell;
  int64_t num_points;
  const double* points; /* (num_points, 3) */
  int64_t num_cells;
  const int32_t* corners; /* (num_cells, corners of a cell): points; NULL: points are those of the cells in turn */
  uint64_t topology;      /* changes whenever num_points, num_cells or corners do */
  int32_t num_arrays;
  const BrecciaArray* arrays;
  int32_t num_point_arrays; /* 0 if values at points were not requested */
  const BrecciaArray* point_arrays;
} BrecciaGrid;

/* An instant of the run. Pointers are valid until the call that gets them returns; the adaptor wraps them, copies
 * nothing it need not, and reads none of them afterwards. */
typedef struct {
  int64_t step;
  double time;                                       /* s, simulated */
  const BrecciaGrid* channels[BRECCIA_NUM_CHANNELS]; /* NULL: not requested by any pipeline of this call */
} BrecciaInstant;

/* A parameter of a pipeline, as it was written: a number or a text. A text that reads as a quantity ("30 MPa") is both.
 * "point_data" is the adaptor's own: the names of values at points that the pipeline gets, separated by commas. */
typedef struct {
  const char* name;
  const char* text; /* NULL: it was written as a number */
  double number;    /* SI; NaN: the text reads as none */
} BrecciaParameter;

/* Points in space at which the pipeline "probes" records fields: at + i / (points - 1) along + j / (rows - 1) across;
 * m. */
typedef struct {
  const char* name; /* of its file */
  double at[3], along[3], across[3];
  int32_t points, rows; /* at least 1 */
} BrecciaProbe;

/* A pipeline: one of the adaptor's own ("fractures", "stress", ...; "live" connects to ParaView) or a script by
 * absolute path. */
typedef struct {
  const char* name;
  uint32_t channels; /* mask of the channels that "live" publishes; 0: those that the pipeline requests */
  int32_t num_parameters;
  const BrecciaParameter* parameters;
  const double* region; /* lower and upper corner of a closed box, m: it gets the cells alone whose centre, the mean of
                           their points, lies within; NULL: all. Rows of a table are no cells. */
  int32_t num_fields;   /* 0: all */
  const char* const* fields; /* the arrays alone that it gets, of all channels; those of a table it gets all */
  int32_t num_probes;        /* of "probes" */
  const BrecciaProbe* probes;
} BrecciaPipeline;

typedef struct {
  int32_t abi_version;
  int32_t communicator; /* MPI_Comm_c2f of the ranks, of which the adaptor makes a communicator of its own; -1: one
                           rank, MPI not started */
  int32_t rank, size;
  double patience;    /* s that a rank which is done with a pipeline waits for the others */
  const char* title;  /* of the case */
  double end;         /* s, simulated, of the run; 0: unknown */
  double strength;    /* Pa, a stress at which something breaks in this case; 0: unknown. Where colours of stress end
                         as long as there is no more than that */
  const char* folder; /* absolute, exists: pipelines write here and nowhere else */
  const char* run;    /* absolute: of the run, which accepts commands there; sent to a live view. "": none */
  const char* live_host;
  int32_t live_port;
  int32_t (*run_ends)(void); /* whether the run is requested to end: a live view that pauses it is disconnected;
                                on the first rank, by any thread; NULL: never */
  int32_t num_pipelines;     /* at most 32 */
  const BrecciaPipeline* pipelines;
} BrecciaConfig;

/* Requests of a script to the solver; those of the first rank apply. A script finds these as arrays of one value in
 * the user data of its data description: "stop", "pause", "extract" (0 or 1), "frame_interval" (s, 0: leave). */
typedef struct {
  int32_t stop, pause, extract;
  double frame_interval;
  double waited; /* s of this call that a person let the run wait: a live view that was paused. No cost of the
                    pipeline's. */
} BrecciaRequests;

/* A message is written into text[0..size), cut to fit, always ended with 0; one line, no newline. */
typedef struct {
  int32_t abi_version;
  const char* description; /* "ParaView Catalyst 5.11.0" */
  const char* data_folder; /* absolute: pipelines/, and python/, the view of `breccia live` */

  /* Whether the back end could start here. 0: it could; the text lists the components found, a line each. Otherwise
   * the text names the missing one. Not collective; starts nothing. */
  int32_t (*find)(char* text, size_t size);

  /* Checks whether all pipelines could run: scripts can be read and compile, names are known, parameters are known to
   * the adaptor's own pipelines, images find a display (one is made when none is there and Xvfb is installed),
   * libraries load, the folder can be written into. 0: all can. Otherwise the text names every problem, problems
   * separated by newlines. On any number of ranks called on each of them, not collective, before open; starts neither
   * MPI nor Python. */
  int32_t (*preflight)(const BrecciaConfig* config, char* text, size_t size);

  /* Starts the back end. NULL: failed, see text. Collective. */
  void* (*open)(const BrecciaConfig* config, char* text, size_t size);

  /* Mask of the channels that a pipeline requests now, and BRECCIA_POINT_VALUES; 0: none, nothing to execute.
   * Collective. */
  uint32_t (*channels)(void* adaptor, int32_t pipeline, int64_t step, double time);

  /* Executes the pipelines of the mask on an instant that has all their channels. Returns the mask of those that failed
   * on any rank; the text has a line for each of them: its name, what went wrong, and where. Collective. -1, on this
   * rank alone: others have not come out of a pipeline in time. Nothing collective can follow, not even close. */
  int64_t (*execute)(void* adaptor, uint32_t pipelines, const BrecciaInstant* instant, BrecciaRequests* requests,
                     char* text, size_t size);

  /* Notices of the pipelines since the last call, failures of an execution excluded, a line each, warnings with
   * "warning: " in front: the same on all ranks. Collective; between calls of `channels` and `execute`. */
  void (*notices)(void* adaptor, char* text, size_t size);

  /* Bytes that a pipeline has written on this rank so far. */
  int64_t (*bytes_written)(void* adaptor, int32_t pipeline);

  /* Ends the pipelines, and all that open has started; the first rank makes animations of the pictures. The
   * notices of all this are in the text, as above, on the first rank. Collective, before MPI_Finalize. */
  void (*close)(void* adaptor, char* text, size_t size);

  /* Feeds what pipelines recorded (folder/<channel>/, as "volume", "fractures", "surface" and others write it) through
   * the pipelines of the config as if a solver ran. folder_of_records is absolute. 0: all instants passed; the text has
   * the notices, on the first rank those of close too. Collective. */
  int32_t (*replay)(const BrecciaConfig* config, const char* folder_of_records, char* text, size_t size);
} BrecciaInsituApi;

const BrecciaInsituApi* breccia_insitu_api(void);

#ifdef __cplusplus
}
#endif

#endif
