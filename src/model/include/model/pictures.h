// The pictures of a scene, read once each.
#pragma once

#include "image/pyramid.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid {

/// A file is read once, however often, by however many paths and links, and with however many encodings it is named. Files
/// that store light have one pyramid; those of bytes have one for each encoding that they are read with, which share the
/// picture itself, and only the smaller levels (a third of it) are their own, because they are averages of light. PNGs of
/// 16 bits are decoded when they are read: one copy for each encoding.
///
/// Bytes stay bytes and halves stay halves; floats become halves where that loses nothing at all.
class Pictures {
  public:
    Pictures() = default;
    /// Throws Error with file:line.
    explicit Pictures(Scene const& scene);

    [[nodiscard]] Pyramid const& operator[](ImageId id) const { return pyramids_[slots_[id.value]]; }
    /// Memory of all levels, shared ones counted once.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::size_t files() const { return files_; }

  private:
    std::vector<Pyramid> pyramids_;
    std::vector<std::uint32_t> slots_;  // by ImageId
    std::size_t bytes_ = 0, files_ = 0;
};

}  // namespace nephroid
