#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace semblante::http {

/// One piece of an endless answer: an event of an event stream. Receivers may share the bytes.
struct FeedItem {
  std::shared_ptr<const std::string> bytes;
};

/// The link between a producer on any thread and the connection that sends. Producers call wake(); the connection, on
/// its own strand, takes items until there is none. The feed decides which items it drops when they are not taken in
/// time.
class Feed {
 public:
  virtual ~Feed() = default;
  /// `wake` may be called from any thread, at any time until the feed is detached with an empty function.
  virtual void attach(std::function<void()> wake) = 0;
  /// The next item; nullopt when there is none now.
  virtual std::optional<FeedItem> take() = 0;
  /// True when no more items will follow: after the last take() the connection is closed.
  [[nodiscard]] virtual bool finished() const = 0;
};

}  // namespace semblante::http
