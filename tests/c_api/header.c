/* The header alone, as C99, with every declaration used: to be compiled, not run. */
#include "hemicube.h"

typedef char sizes_are_first[offsetof(hc_options, struct_size) == 0 ? 1 : -1];
typedef char enums_are_ints[sizeof(HC_RUNG_EXACT) == sizeof(int) ? 1 : -1];

int header_is_c99(void) {
  hc_options options = {.struct_size = sizeof options};
  return options.rung == HC_RUNG_CHOSEN ? HC_OK : HC_INVALID_ARGUMENT;
}
