#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace semblante::http {

/// One piece of an endless answer: an event of an event stream. Many receivers may share the bytes.
struct FeedItem {
  std::shared_ptr<const std::string> bytes;
};

/// Where a producer on any thread meets the connection that sends. Producers call wake(); the connection, on its own
/// strand, takes items until there is none. A feed decides itself what it drops when nobody takes.
class Feed {
 public:
  virtual ~Feed() = default;
  /// `wake` may be called from any thread, at any time until the feed is detached with an empty function.
  virtual void attach(std::function<void()> wake) = 0;
  /// The next item, or nothing for now.
  virtual std::optional<FeedItem> take() = 0;
  /// True when nothing more will come: after the last take() the connection is closed.
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace semblante::http
