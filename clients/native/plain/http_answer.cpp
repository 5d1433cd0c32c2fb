#include "clients/native/plain/http_answer.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/types/letter_case.h"

namespace semblante::client {
namespace {

Error malformed(const char* what) { return {ErrorCode::malformed, "answer", what}; }
Error too_large(const char* what) { return {ErrorCode::too_large, "answer", what}; }

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// All of `text` as a number; nullopt for anything else.
std::optional<std::uint64_t> whole_number(std::string_view text, int base) {
  std::uint64_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return problem == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// The part of `text` before `mark`, which is removed from it with the mark; all of it if there is no mark.
std::string_view cut(std::string_view& text, std::string_view mark) {
  const std::size_t end = text.find(mark);
  const std::string_view front = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + mark.size());
  return front;
}

}  // namespace

Result<bool> HttpAnswer::take(std::string_view bytes) {
  held_.append(bytes);
  Result<bool> goes_on = true;
  while (goes_on && *goes_on && part_ != Part::whole) goes_on = step();
  if (!goes_on) return goes_on;
  held_.erase(0, at_);
  at_ = 0;
  return part_ == Part::whole;
}

bool HttpAnswer::close() {
  if (part_ == Part::body_to_close) part_ = Part::whole;
  return part_ == Part::whole;
}

Result<bool> HttpAnswer::step() {
  switch (part_) {
    case Part::head: {
      const std::size_t end = rest().find("\r\n\r\n");
      if (std::min(end, rest().size()) > limits_.max_header) return too_large("the header is too long");
      // Another protocol is known by its first bytes.
      constexpr std::string_view begin = "HTTP/1.";
      if (!rest().starts_with(begin.substr(0, rest().size()))) return malformed("this is not HTTP/1.1");
      if (end == std::string_view::npos) return false;
      auto read = read_head(rest().substr(0, end));
      at_ += end + 4;
      if (!read) return std::move(read).error();
      return true;
    }
    case Part::body:
      move_body(remaining_);
      if (remaining_ == 0) part_ = Part::whole;
      return remaining_ == 0;
    case Part::body_to_close:
      if (auto fits = expect_body(rest().size()); !fits) return std::move(fits).error();
      move_body(remaining_);
      return false;
    case Part::chunk_head: {
      std::string_view line;
      auto is_there = take_line(line);
      if (!is_there || !*is_there) return is_there;
      const auto size = whole_number(trimmed(cut(line, ";")), 16);
      if (!size) return malformed("a chunk begins with its size");
      around_ = 0;
      if (auto fits = expect_body(*size); !fits) return std::move(fits).error();
      part_ = *size == 0 ? Part::trailers : Part::chunk;
      return true;
    }
    case Part::chunk:
      move_body(remaining_);
      if (remaining_ == 0) part_ = Part::chunk_end;
      return remaining_ == 0;
    case Part::chunk_end:
    case Part::trailers: {
      std::string_view line;
      auto is_there = take_line(line);
      if (!is_there || !*is_there) return is_there;
      if (part_ == Part::chunk_end) {
        if (!line.empty()) return malformed("a chunk is longer than its size");
        part_ = Part::chunk_head;
      } else if (line.empty()) {
        part_ = Part::whole;
      }
      return true;
    }
    case Part::whole:
      break;
  }
  return false;
}

Status HttpAnswer::read_head(std::string_view head) {
  response_ = {};
  std::string_view line = cut(head, "\r\n");  // "HTTP/1.1 200 OK"
  cut(line, " ");
  const auto status = whole_number(cut(line, " "), 10);
  if (!status || *status < 100 || *status > 999) return malformed("the status is a number of three digits");
  response_.status = static_cast<int>(*status);
  response_.reason = line;
  bool is_chunked = false;
  std::optional<std::uint64_t> length;
  while (!head.empty()) {
    std::string_view value = cut(head, "\r\n");
    const bool has_colon = value.find(':') != std::string_view::npos;
    const std::string name = lower_case(cut(value, ":"));
    if (!has_colon || name.empty() || name.find_first_of(" \t") != std::string::npos) {
      return malformed("a header field is NAME: VALUE");
    }
    value = trimmed(value);
    if (name == "content-length") {
      const auto stated = whole_number(value, 10);
      if (!stated || (length && *length != *stated)) return malformed("Content-Length is one number");
      length = stated;
    }
    if (name == "transfer-encoding") {
      if (is_chunked || !equal_ignoring_case(value, "chunked")) return malformed("the only transfer coding is chunked");
      is_chunked = true;
    }
    response_.headers.emplace_back(name, value);
  }
  if (is_chunked && length) return malformed("both Content-Length and chunks");
  const int code = response_.status;
  if (code < 200 && code != 101) return Unit{};  // the answer itself follows
  if (is_head_ || code == 101 || code == 204 || code == 304) {
    part_ = Part::whole;
  } else if (is_chunked) {
    part_ = Part::chunk_head;
  } else if (length) {
    part_ = Part::body;
    return expect_body(*length);
  } else {
    part_ = Part::body_to_close;
  }
  return Unit{};
}

Result<bool> HttpAnswer::take_line(std::string_view& line) {
  const std::size_t end = rest().find("\r\n");
  const bool is_there = end != std::string_view::npos;
  // The head of each chunk, and all trailers, are as bounded as the header.
  if (around_ + (is_there ? end : rest().size()) > limits_.max_header)
    return too_large("the parts around chunks are too long");
  if (!is_there) return false;
  line = rest().substr(0, end);
  around_ += end;
  at_ += end + 2;
  return true;
}

Status HttpAnswer::expect_body(std::uint64_t bytes) {
  if (bytes > limits_.max_body - response_.body.size()) return too_large("the body is larger than expected");
  remaining_ = bytes;
  return Unit{};
}

void HttpAnswer::move_body(std::uint64_t most) {
  const std::string_view piece = rest().substr(0, most);
  response_.body.append(piece);
  at_ += piece.size();
  remaining_ -= piece.size();
}

}  // namespace semblante::client
