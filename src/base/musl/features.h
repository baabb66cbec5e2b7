/* The part of musl's own features.h that its mathematics needs, beside the system's. */
#include_next <features.h>
#ifndef hidden
#define hidden __attribute__((__visibility__("hidden")))
#endif
