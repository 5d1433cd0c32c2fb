#include "clients/native/viewer/show.h"

#include <algorithm>
#include <utility>

namespace semblante::viewer {
namespace {

bool is_same_moment(const client::DisplayedFrame& a, const client::DisplayedFrame& b) {
  return a.t == b.t && a.from.sequence == b.from.sequence && a.to.sequence == b.to.sequence &&
         a.from.media_time == b.from.media_time && a.to.media_time == b.to.media_time;
}

}  // namespace

Show::Show(Follower& follower, const ShowOptions& options, render::GlScreen screen)
    : follower_(follower), options_(options), screen_(std::move(screen)) {
  if (options_.quality == Quality::low) {
    pace_.take_least();
  }
}

Result<std::unique_ptr<Show>> Show::create(Follower& follower, const ShowOptions& options) {
  auto screen = render::GlScreen::create();
  if (!screen) {
    return std::move(screen).error();
  }
  return std::unique_ptr<Show>(new Show(follower, options, *std::move(screen)));
}

Status Show::wear(LoadedFace&& loaded) {
  head_.reset();
  auto head = render::GlHead::create(std::move(loaded.scene));
  if (!head) {
    return std::move(head).error();
  }
  head_ = *std::move(head);
  head_->set_shadow_side(pace_.effort().shadow_side);
  face_ = std::move(loaded.face);
  header_.reset();
  shown_.reset();
  return Unit{};
}

Result<bool> Show::update() {
  bool changes = false;
  if (auto loaded = follower_.take_face()) {
    if (auto worn = wear(std::move(*loaded)); !worn) {
      return std::move(worn).error();
    }
    changes = true;
  }
  Now now = follower_.now();
  if (now.words != words_) {
    words_ = std::move(now.words);
    changes = true;
  }
  if (!head_ || !now.header) {
    return changes;
  }
  if (header_ != now.header) {
    header_ = now.header;
    face_->play_by(*header_);
    shown_.reset();
  }
  if (!now.frame || (shown_ && is_same_moment(*shown_, *now.frame))) {
    return changes;
  }
  shown_ = now.frame;
  // A frame of a stream is finite: both readers check it.
  static_cast<void>(semblante_head_set_interpolated(face_->head(), &shown_->from.frame, &shown_->to.frame, shown_->t));
  if (auto set = head_->set_positions(face_->positions()); !set) {
    return std::move(set).error();
  }
  return true;
}

Status Show::draw(int width, int height, double seconds) {
  render::Camera camera;
  if (head_) {
    const render::Subjects& subjects = head_->scene().subjects;
    camera = orbit_.camera(subjects[options_.subject], subjects.all,
                           static_cast<float>(width) / static_cast<float>(std::max(height, 1)));
  }
  auto drawn = screen_.draw(head_ ? &*head_ : nullptr, camera, width, height, pace_.effort().samples, words_);
  if (!drawn || !head_ || options_.quality == Quality::high) {
    return drawn;
  }
  const RigDocument& rig = face_->rig();
  switch (pace_.tick(seconds, rig.lod + 1 < rig.levels.size())) {
    case Pace::Step::none:
      break;
    case Pace::Step::effort:
      head_->set_shadow_side(pace_.effort().shadow_side);
      break;
    case Pace::Step::smaller_level:
      follower_.load_level(rig.lod + 1);
      break;
  }
  return Unit{};
}

std::string Show::face_name() const {
  if (!face_) {
    return {};
  }
  return face_->rig().name + ", level " + std::to_string(face_->rig().lod) + ", " +
         std::to_string(face_->rig().mesh.vertices) + " vertices";
}

}  // namespace semblante::viewer
