#pragma once

#include <type_traits>

#include <nlohmann/json.hpp>

#include "server/api/answer_types.h"

/// Conversion of answer members to JSON; included by the generated writers only.
namespace semblante::api::answer {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_members = false;
template <class T>
inline constexpr bool is_members<Members<T>> = true;
template <class T>
inline constexpr bool is_numbers = false;
template <std::size_t size>
inline constexpr bool is_numbers<std::array<double, size>> = true;
template <class T>
inline constexpr bool is_word = false;
template <class Words>
inline constexpr bool is_word<Word<Words>> = true;

template <class T>
Json value_to_json(const T& value) {
  if constexpr (is_optional<T>) {
    return value ? value_to_json(*value) : Json(nullptr);
  } else if constexpr (is_members<T>) {
    Json json = Json::object();
    for (const auto& [name, member] : value) json[name] = value_to_json(member);
    return json;
  } else if constexpr (is_list<T>) {
    Json json = Json::array();
    for (const auto& item : value) json.push_back(value_to_json(item));
    return json;
  } else if constexpr (is_word<T>) {
    return value.text();
  } else if constexpr (std::is_same_v<T, JsonText>) {
    return Json::parse(value.text, nullptr, false);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string> || is_numbers<T>) {
    return value;
  } else {
    return to_json(value);
  }
}

/// Adds the members of another object.
template <class Answer>
void merge(Json& json, const Answer& object) {
  json.update(value_to_json(object));
}

}  // namespace semblante::api::answer
