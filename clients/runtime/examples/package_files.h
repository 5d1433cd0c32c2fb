/* The three artefacts of a face package from a folder to a head. The caller destroys it. */
#ifndef PACKAGE_FILES_H
#define PACKAGE_FILES_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <semblante/semblante.h>

/* Memory of malloc; null with a message when the file cannot be read. */
static void* read_file(const char* folder, const char* name, size_t* size) {
  char path[4096];
  char* bytes = NULL;
  FILE* file;
  long length;
  snprintf(path, sizeof(path), "%s/%s", folder, name);
  file = fopen(path, "rb");
  if (file != NULL && fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) > 0) {
    rewind(file);
    bytes = (char*)malloc((size_t)length);
    if (bytes != NULL) *size = fread(bytes, 1, (size_t)length, file);
  }
  if (file != NULL) fclose(file);
  if (bytes == NULL) fprintf(stderr, "%s cannot be read\n", path);
  return bytes;
}

/* Null with a message when a part is missing or wrong. */
static semblante_head* read_head(const char* folder) {
  semblante_head* head = NULL;
  semblante_package package;
  semblante_error error;
  void *mesh, *weights, *rig;
  memset(&package, 0, sizeof(package));
  package.size = sizeof(package);
  mesh = read_file(folder, "mesh.drc", &package.mesh_drc_size);
  weights = read_file(folder, "weights", &package.weights_size);
  rig = read_file(folder, "rig.json", &package.rig_json_size);
  package.mesh_drc = (const uint8_t*)mesh;
  package.weights = (const uint8_t*)weights;
  package.rig_json = (const char*)rig;
  if (mesh != NULL && weights != NULL && rig != NULL &&
      semblante_head_create(&package, NULL, &head, &error) != SEMBLANTE_OK) {
    fprintf(stderr, "%s: %s\n", error.where, error.message);
  }
  free(mesh); /* everything needed is copied */
  free(weights);
  free(rig);
  return head;
}

#endif
