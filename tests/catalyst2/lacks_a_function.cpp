// Something that is called libcatalyst and has not all of its functions.

extern "C" __attribute__((visibility("default"))) int catalyst_initialize(const void*) { return 0; }
extern "C" __attribute__((visibility("default"))) int catalyst_execute(const void*) { return 0; }
