/* What the library computes, number for number, to be compared between machines:  probe FOLDER < lines
 *
 * A line is `stream` (a new one begins) or a message of a server in hexadecimal. For each frame that arrives: its time,
 * its FAPs, ARKit's coefficients for it, and the FAPs of those; for the last of each stream all vertices and normals of
 * the face. Numbers are hexadecimal, so that no digit is lost. */
#include "package_files.h"

static void print_numbers(const char* name, const float* numbers, size_t count) {
  size_t i;
  printf("%s", name);
  for (i = 0; i < count; ++i) printf(" %a", (double)numbers[i]);
  printf("\n");
}

static void print_frame(const semblante_timed_frame* frame) {
  float shapes[52];
  semblante_frame again;
  semblante_error error;
  const semblante_frame* f = &frame->frame;
  printf("frame %a %u %u %u %u %u %u %u\n", frame->time, (unsigned)f->viseme1, (unsigned)f->viseme2,
         (unsigned)f->viseme_blend, (unsigned)f->expression1, (unsigned)f->intensity1, (unsigned)f->expression2,
         (unsigned)f->intensity2);
  print_numbers("faps", f->fap + 3, 66);
  if (semblante_arkit_from_frame(f, shapes) != SEMBLANTE_OK) return;
  print_numbers("arkit", shapes, 52);
  if (semblante_frame_from_arkit(shapes, &again, &error) == SEMBLANTE_OK) print_numbers("again", again.fap + 3, 66);
}

static void print_face(semblante_head* head, const semblante_frame* frame) {
  const size_t numbers = (size_t)semblante_head_vertex_count(head) * 3;
  float* values = (float*)malloc(2 * numbers * sizeof(float));
  if (values != NULL && semblante_head_set_frame(head, frame) == SEMBLANTE_OK &&
      semblante_head_positions(head, values, numbers) == SEMBLANTE_OK &&
      semblante_head_normals(head, values, values + numbers, numbers) == SEMBLANTE_OK) {
    print_numbers("positions", values, numbers);
    print_numbers("normals", values + numbers, numbers);
  }
  free(values);
}

int main(int argc, char** argv) {
  static char line[1 << 20];
  static uint8_t bytes[1 << 19];
  semblante_stream* stream = NULL;
  semblante_timed_frame last;
  double now = 1000;
  semblante_head* head = argc == 2 ? read_head(argv[1]) : NULL;
  if (head == NULL) return 1;
  memset(&last, 0, sizeof(last));
  while (fgets(line, sizeof(line), stdin) != NULL) {
    if (strncmp(line, "stream", 6) == 0) {
      if (stream != NULL) print_face(head, &last.frame);
      semblante_stream_destroy(stream);
      if (semblante_stream_create(NULL, &stream, NULL) != SEMBLANTE_OK) return 1;
      semblante_stream_start(stream, now);
      semblante_stream_opened(stream, now);
      printf("stream\n");
    } else {
      semblante_event event;
      size_t size = 0;
      unsigned byte;
      while (size < sizeof(bytes) && sscanf(line + 2 * size, "%2x", &byte) == 1) bytes[size++] = (uint8_t)byte;
      now += 10;
      semblante_stream_receive(stream, bytes, size, now);
      event.size = sizeof(event);
      while (semblante_stream_next_event(stream, &event)) {
        uint32_t count, i;
        const semblante_timed_frame* frames;
        if (event.type == SEMBLANTE_EVENT_FAULT) printf("fault %s\n", event.error.message);
        if (event.type != SEMBLANTE_EVENT_KEYFRAME && event.type != SEMBLANTE_EVENT_FRAMES) continue;
        frames = semblante_stream_frames(stream, &count);
        printf("%s %u\n", event.type == SEMBLANTE_EVENT_KEYFRAME ? "keyframe" : "frames", (unsigned)count);
        for (i = 0; i < count; ++i) print_frame(&frames[i]);
        if (count > 0) last = frames[count - 1];
      }
    }
  }
  if (stream != NULL) print_face(head, &last.frame);
  semblante_stream_destroy(stream);
  semblante_head_destroy(head);
  return 0;
}
