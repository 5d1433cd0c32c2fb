/* Keeps the SDK's header C99, and shows a whole integration in one function. */
#include "tests/unit/runtime/sdk_from_c.h"

semblante_result open_jaw_from_c(const semblante_package* package, float* positions, size_t capacity) {
  semblante_head* head = NULL;
  semblante_head_options options = {0};
  semblante_frame frame = {0};
  semblante_error error;
  semblante_result result;
  options.size = sizeof(options);
  result = semblante_head_create(package, &options, &head, &error);
  if (result != SEMBLANTE_OK) {
    return result;
  }
  frame.fap[3] = 100.0f;
  result = semblante_head_set_frame(head, &frame);
  if (result == SEMBLANTE_OK) {
    result = semblante_head_positions(head, positions, capacity);
  }
  semblante_head_destroy(head);
  return result;
}
