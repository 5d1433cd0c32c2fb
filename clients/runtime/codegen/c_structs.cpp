#include "clients/runtime/codegen/c_structs.h"

#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace semblante::codegen {
namespace {

using Constants = std::map<std::string, int>;

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(/\*[^*]*\*+(?:[^/*][^*]*\*+)*/)"), " ");
}

std::string one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

/// The words of a comment of one or more lines.
std::string comment_text(const std::string& comment) {
  static const std::regex marks(R"((^|\n)\s*/?\*+/?|\*/\s*$)");
  return one_line(std::regex_replace(comment, marks, "$1"));
}

Constants constants_of(const std::string& text) {
  Constants found;
  const std::regex definition(R"(#define (SEMBLANTE_\w+) (\d+)u?\s)");
  for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at)
    found[(*at)[1]] = std::stoi((*at)[2]);
  return found;
}

/// "SEMBLANTE_FP_COUNT * 3", "SEMBLANTE_FAP_COUNT + 1", "4".
int length_of(const std::string& expression, const Constants& constants) {
  std::istringstream words(expression);
  int value = 0;
  char operation = '+';
  for (std::string word; words >> word;) {
    if (word == "+" || word == "*") {
      operation = word[0];
      continue;
    }
    const auto named = constants.find(word);
    const bool digits = word.find_first_not_of("0123456789") == std::string::npos;
    if (named == constants.end() && !digits) throw std::runtime_error("unknown length: " + expression);
    const int number = digits ? std::stoi(word) : named->second;
    value = operation == '*' ? value * number : value + number;
  }
  return value;
}

/// "const float* rest", "uint8_t viseme1, viseme2", "float eye_pivot[2][3]".
void read_members(const std::string& declaration, const Constants& constants, std::vector<CMember>& members) {
  static const std::regex whole(R"((?:const )?(\w+)(\*?) (.+))");
  static const std::regex declarator(R"((\w+)((?:\[[^\]]+\])*))");
  std::smatch parts;
  if (!std::regex_match(declaration, parts, whole)) throw std::runtime_error("not understood: " + declaration);
  const std::string names = parts[3];
  for (std::sregex_iterator at(names.begin(), names.end(), declarator), end; at != end; ++at) {
    CMember member{(*at)[1], parts[1], parts[2].length() > 0, {}};
    const std::string lengths = (*at)[2];
    static const std::regex length(R"(\[([^\]]+)\])");
    for (std::sregex_iterator in(lengths.begin(), lengths.end(), length); in != end; ++in)
      member.lengths.push_back(length_of((*in)[1], constants));
    members.push_back(member);
  }
  if (std::regex_replace(names, declarator, "").find_first_not_of(", ") != std::string::npos)
    throw std::runtime_error("not understood: " + declaration);
}

}  // namespace

std::string camel_case_name(const CStruct& record) {
  std::string name;
  bool begins = true;
  for (const char c : record.name.substr(std::string("semblante_").size())) {
    if (c != '_') name += begins ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return name;
}

std::vector<CStruct> read_c_structs(const std::string& header, const std::string& more) {
  Constants constants = constants_of(more);
  constants.merge(constants_of(header));
  std::vector<CStruct> structs;
  const std::string begin = "typedef struct ";
  for (std::size_t at = header.find(begin); at != std::string::npos; at = header.find(begin, at + 1)) {
    const std::size_t name_at = at + begin.size();
    const std::size_t name_end = header.find_first_of(" ;", name_at);
    const std::string name = header.substr(name_at, name_end - name_at);
    if (header.compare(name_end, 2, " {") != 0) continue;  // an opaque handle
    const std::size_t end = header.find("} " + name + ";", name_end);
    if (end == std::string::npos) throw std::runtime_error(name + " has no end");
    CStruct made{name, {}, {}};
    // The comment that ends in the line before.
    if (at >= 3 && header.compare(at - 3, 3, "*/\n") == 0) {
      const std::size_t from = header.rfind("/*", at);
      made.doc = comment_text(header.substr(from, at - from));
    }
    std::istringstream body(without_comments(header.substr(name_end + 2, end - name_end - 2)));
    try {
      for (std::string declaration; std::getline(body, declaration, ';');) {
        declaration = one_line(declaration);
        if (!declaration.empty()) read_members(declaration, constants, made.members);
      }
    } catch (const std::runtime_error& fault) {
      throw std::runtime_error(name + ": " + fault.what());
    }
    structs.push_back(std::move(made));
  }
  return structs;
}

}  // namespace semblante::codegen
