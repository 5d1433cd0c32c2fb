/* A face package to a face that speaks, as an OBJ file:  hello_face FOLDER OUT.obj
 *
 * FOLDER holds mesh.drc, weights and rig.json, as `semblante parametrize --out FOLDER` or three downloads leave them.
 *
 *   cc hello_face.c $(pkg-config --cflags --libs semblante) -o hello_face */
#include "package_files.h"

static int write_obj(const semblante_head* head, const char* path) {
  const uint32_t vertices = semblante_head_vertex_count(head);
  uint32_t triangles = 0, i;
  const uint32_t* corners = semblante_head_triangles(head, &triangles);
  const uint8_t* colors = semblante_head_colors(head);
  float* positions = (float*)malloc((size_t)vertices * 3 * sizeof(float));
  FILE* file = fopen(path, "w");
  int is_written = positions != NULL && file != NULL &&
                   semblante_head_positions(head, positions, (size_t)vertices * 3) == SEMBLANTE_OK;
  for (i = 0; is_written && i < vertices; ++i) {
    const float* p = positions + (size_t)i * 3;
    fprintf(file, "v %.6g %.6g %.6g", p[0], p[1], p[2]);
    if (colors != NULL) {
      const uint8_t* c = colors + (size_t)i * 3;
      fprintf(file, " %.6g %.6g %.6g", c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
    }
    fprintf(file, "\n");
  }
  for (i = 0; is_written && i < triangles; ++i) {
    const uint32_t* c = corners + (size_t)i * 3;
    fprintf(file, "f %u %u %u\n", (unsigned)c[0] + 1, (unsigned)c[1] + 1, (unsigned)c[2] + 1);
  }
  if (file != NULL && fclose(file) != 0) is_written = 0;
  free(positions);
  if (!is_written) fprintf(stderr, "%s cannot be written\n", path);
  return is_written;
}

int main(int argc, char** argv) {
  semblante_head* head;
  semblante_frame frame;
  int is_written;
  if (argc != 3) {
    fprintf(stderr, "usage: %s FOLDER OUT.obj\n", argv[0]);
    return 2;
  }
  head = read_head(argv[1]);
  if (head == NULL) return 1;

  memset(&frame, 0, sizeof(frame));
  frame.viseme1 = 10; /* "a" as in "car", alone */
  frame.viseme_blend = 63;
  frame.fap[3] = 120; /* the jaw a little lower, in units of MNS: the distance from mouth to nose / 1024 */
  semblante_head_set_frame(head, &frame);

  is_written = write_obj(head, argv[2]);
  printf("%u vertices\n", (unsigned)semblante_head_vertex_count(head));
  semblante_head_destroy(head);
  return is_written ? 0 : 1;
}
