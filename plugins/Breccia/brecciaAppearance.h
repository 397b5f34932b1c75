#ifndef brecciaAppearance_h
#define brecciaAppearance_h

/// Defines how ParaView shows the arrays of runs: titles of scalar bars with units, colours, names of modes and states.
/// Settings of the lowest priority: what the user has saved for an array holds.
void brecciaSetAppearance();

#endif
