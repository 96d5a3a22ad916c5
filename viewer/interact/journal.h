#pragma once

/// What was done: every operation with the scene it made.

#include <cstdint>
#include <string>
#include <vector>

#include "deform/scene/operation_text.h"
#include "deform/scene/scene.h"
#include "lattice/core/progress.h"

namespace espalier::viewer {

/// A scene with its past and, after undo(), its future. Scenes share what did not change, so every
/// step keeps its own.
class Journal {
 public:
  /// The scene as it is now.
  [[nodiscard]] const Scene& scene() const {
    return n_done_ == 0 ? first_ : steps_[n_done_ - 1].scene;
  }

  /// Does an operation; what was undone is forgotten. Throws as the operation and changes nothing
  /// then.
  void apply(const OperationCall& call, const Progress& progress = {});
  /// Back to before the last operation that changed the scene; false if there is none.
  bool undo();
  /// Forward again; false if nothing was undone.
  bool redo();
  [[nodiscard]] bool can_undo() const;
  [[nodiscard]] bool can_redo() const { return n_done_ < steps_.size(); }

  /// The operations that led here, one a line.
  [[nodiscard]] std::string text() const;
  /// Grows whenever text() may have become another.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Whether the scene changed since this was last marked as saved, or since the beginning.
  [[nodiscard]] bool is_changed() const { return n_done_ != n_saved_; }
  void mark_saved() { n_saved_ = n_done_; }

 private:
  struct Step {
    std::string line;
    bool changes_scene;
    Scene scene;
  };
  Scene first_;
  std::vector<Step> steps_;
  std::size_t n_done_ = 0;
  std::uint64_t revision_ = 0;
  std::size_t n_saved_ = 0;
};

/// Does every line of a journal's text; empty lines and those that begin with # are skipped, and so
/// are those that would write a file once more, which may be another one now. Throws ParameterError
/// naming the line that cannot be read or done; the lines before it stay done.
void replay(const std::string& text, Journal& journal, const Progress& progress = {});

}  // namespace espalier::viewer
