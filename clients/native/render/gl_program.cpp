#include "clients/native/render/gl_program.h"

#include <array>

#include <GLES3/gl3.h>

namespace semblante::render {
namespace {

Result<GLuint> compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::array<char, 1024> words{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
    glDeleteShader(shader);
    return Error{ErrorCode::internal, "shader", words.data()};
  }
  return shader;
}

}  // namespace

Result<unsigned> link_program(const char* vertex_source, const char* fragment_source) {
  auto vertex = compile(GL_VERTEX_SHADER, vertex_source);
  if (!vertex) {
    return std::move(vertex).error();
  }
  auto fragment = compile(GL_FRAGMENT_SHADER, fragment_source);
  if (!fragment) {
    glDeleteShader(*vertex);
    return std::move(fragment).error();
  }
  const GLuint program = glCreateProgram();
  glAttachShader(program, *vertex);
  glAttachShader(program, *fragment);
  glLinkProgram(program);
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == 0) {
    std::array<char, 1024> words{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(words.size()), nullptr, words.data());
    glDeleteProgram(program);
    return Error{ErrorCode::internal, "program", words.data()};
  }
  return program;
}

}  // namespace semblante::render
