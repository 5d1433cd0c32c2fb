#include "core/anatomy/point_order.h"

#include <limits>
#include <string_view>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "core/types/places.h"

namespace semblante {
namespace {

using enum FaceAxis;

struct NamedOrder {
  FaceAxis axis;
  std::string_view more, less;
};

constexpr auto named_orders = std::to_array<NamedOrder>({
    // top to bottom
    {up, "11.4", "11.1"},
    {up, "11.1", "4.1"},
    {up, "11.1", "4.2"},
    {up, "11.3", "4.3"},
    {up, "11.2", "4.4"},
    {up, "4.1", "3.11"},
    {up, "4.2", "3.8"},
    {up, "4.3", "3.13"},
    {up, "4.4", "3.14"},
    {up, "4.5", "3.7"},
    {up, "4.6", "3.12"},
    {up, "3.13", "3.1"},
    {up, "3.14", "3.2"},
    {up, "3.1", "3.3"},
    {up, "3.2", "3.4"},
    {up, "3.3", "3.9"},
    {up, "3.4", "3.10"},
    {up, "3.9", "9.15"},
    {up, "3.10", "9.15"},
    {up, "3.5", "9.15"},
    {up, "3.6", "9.15"},
    {up, "9.7", "9.13"},
    {up, "9.6", "9.14"},
    {up, "9.12", "9.3"},
    {up, "9.3", "8.1"},
    {up, "9.15", "8.1"},
    {up, "9.1", "8.3"},
    {up, "9.2", "8.4"},
    {up, "8.1", "2.2"},
    {up, "8.10", "2.2"},
    {up, "8.9", "2.2"},
    {up, "8.5", "2.6"},
    {up, "8.6", "2.7"},
    {up, "2.2", "2.3"},
    {up, "2.6", "2.8"},
    {up, "2.7", "2.9"},
    {up, "2.3", "8.2"},
    {up, "2.8", "8.7"},
    {up, "2.9", "8.8"},
    {up, "8.2", "2.10"},
    {up, "8.7", "2.11"},
    {up, "8.8", "2.12"},
    {up, "2.10", "2.1"},
    {up, "5.3", "8.3"},
    {up, "5.4", "8.4"},
    {up, "5.3", "5.1"},
    {up, "5.4", "5.2"},
    {up, "10.1", "10.3"},
    {up, "10.2", "10.4"},
    {up, "10.3", "10.5"},
    {up, "10.4", "10.6"},
    {up, "10.9", "10.7"},
    {up, "10.10", "10.8"},
    {up, "9.8", "9.10"},
    {up, "9.11", "9.9"},
    // the face's left to right
    {left, "3.7", "3.5"},
    {left, "3.5", "3.11"},
    {left, "3.7", "3.1"},
    {left, "3.1", "3.11"},
    {left, "3.7", "3.3"},
    {left, "3.3", "3.11"},
    {left, "3.7", "3.9"},
    {left, "3.9", "3.11"},
    {left, "3.7", "3.13"},
    {left, "3.13", "3.11"},
    {left, "3.11", "3.8"},
    {left, "3.8", "3.6"},
    {left, "3.6", "3.12"},
    {left, "3.8", "3.2"},
    {left, "3.2", "3.12"},
    {left, "3.8", "3.4"},
    {left, "3.4", "3.12"},
    {left, "3.8", "3.10"},
    {left, "3.10", "3.12"},
    {left, "3.8", "3.14"},
    {left, "3.14", "3.12"},
    {left, "4.5", "4.3"},
    {left, "4.3", "4.1"},
    {left, "4.1", "4.2"},
    {left, "4.2", "4.4"},
    {left, "4.4", "4.6"},
    {left, "8.3", "2.4"},
    {left, "2.4", "2.6"},
    {left, "2.6", "2.2"},
    {left, "2.2", "2.7"},
    {left, "2.7", "2.5"},
    {left, "2.5", "8.4"},
    {left, "2.4", "2.8"},
    {left, "2.8", "2.3"},
    {left, "2.3", "2.9"},
    {left, "2.9", "2.5"},
    {left, "8.3", "8.5"},
    {left, "8.5", "8.10"},
    {left, "8.10", "8.1"},
    {left, "8.1", "8.9"},
    {left, "8.9", "8.6"},
    {left, "8.6", "8.4"},
    {left, "8.3", "8.7"},
    {left, "8.7", "8.2"},
    {left, "8.2", "8.8"},
    {left, "8.8", "8.4"},
    {left, "9.1", "9.3"},
    {left, "9.3", "9.2"},
    {left, "9.13", "9.12"},
    {left, "9.12", "9.14"},
    {left, "2.13", "2.11"},
    {left, "2.11", "2.10"},
    {left, "2.10", "2.12"},
    {left, "2.12", "2.14"},
    {left, "10.3", "3.7"},
    {left, "3.12", "10.4"},
    {left, "11.3", "11.1"},
    {left, "11.1", "11.2"},
    {left, "5.3", "3.11"},
    {left, "3.8", "5.4"},
    // front to back
    {front, "9.3", "9.15"},
    {front, "9.3", "9.1"},
    {front, "9.3", "9.2"},
    {front, "9.3", "3.11"},
    {front, "9.3", "3.8"},
    {front, "2.10", "2.13"},
    {front, "2.10", "2.14"},
    {front, "8.1", "8.3"},
    {front, "8.1", "8.4"},
    {front, "2.2", "2.4"},
    {front, "2.2", "2.5"},
    {front, "2.3", "2.4"},
    {front, "2.3", "2.5"},
    {front, "9.3", "7.1"},
    {front, "7.1", "11.6"},
    {front, "9.3", "10.3"},
    {front, "9.3", "10.4"},
    {front, "10.3", "11.6"},
    {front, "10.4", "11.6"},
    {front, "3.7", "10.9"},
    {front, "3.12", "10.10"},
});

using Orders = std::array<PointOrder, named_orders.size()>;

Orders parsed_orders() {
  Orders orders{};
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const auto& [axis, more, less] = named_orders[i];
    orders[i] = {axis, *parse_feature_point(more), *parse_feature_point(less)};
  }
  return orders;
}

}  // namespace

std::span<const PointOrder> point_orders() {
  static const Orders orders = parsed_orders();
  return orders;
}

bool OrderBounds::contains(const glm::dvec3& place) const {
  return glm::all(glm::greaterThanEqual(place, least)) && glm::all(glm::lessThanEqual(place, most));
}

OrderBounds order_bounds(FeaturePointId id, const Places& places) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  OrderBounds bounds{glm::dvec3(-endless), glm::dvec3(endless)};
  for (const PointOrder& order : point_orders()) {
    const auto axis = static_cast<int>(order.axis);
    if (const auto& less = places[order.less.value()]; order.more == id && less) {
      bounds.least[axis] = glm::max(bounds.least[axis], (*less)[axis] - point_order_tolerance);
    }
    if (const auto& more = places[order.more.value()]; order.less == id && more) {
      bounds.most[axis] = glm::min(bounds.most[axis], (*more)[axis] + point_order_tolerance);
    }
  }
  return bounds;
}

}  // namespace semblante
