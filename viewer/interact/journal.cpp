#include "viewer/interact/journal.h"

#include <sstream>
#include <utility>

#include "deform/scene/operations.h"
#include "lattice/core/error.h"

namespace espalier::viewer {

void Journal::apply(const OperationCall& call, const Progress& progress) {
  Scene next = espalier::apply(call, scene(), progress);
  Step step{text_of(call), operation_named(call.operation).changes_scene, std::move(next)};
  if (n_saved_ > n_done_) {
    n_saved_ = std::string::npos;  // what was saved can no longer be reached
  }
  const bool was_saved = n_saved_ == n_done_;
  steps_.resize(n_done_);
  steps_.push_back(std::move(step));
  ++n_done_;
  ++revision_;
  if (was_saved && !steps_.back().changes_scene) {
    n_saved_ = n_done_;
  }
}

bool Journal::can_undo() const {
  for (std::size_t i = 0; i < n_done_; ++i) {
    if (steps_[i].changes_scene) {
      return true;
    }
  }
  return false;
}

bool Journal::undo() {
  if (!can_undo()) {
    return false;
  }
  while (!steps_[n_done_ - 1].changes_scene) {
    --n_done_;
  }
  --n_done_;
  ++revision_;
  return true;
}

bool Journal::redo() {
  if (!can_redo()) {
    return false;
  }
  ++n_done_;
  ++revision_;
  while (n_done_ < steps_.size() && !steps_[n_done_].changes_scene) {
    ++n_done_;
  }
  return true;
}

std::string Journal::text() const {
  std::string text;
  for (std::size_t i = 0; i < n_done_; ++i) {
    text += steps_[i].line + "\n";
  }
  return text;
}

void replay(const std::string& text, Journal& journal, const Progress& progress) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    try {
      const OperationCall call = parse_call(line);
      if (operation_named(call.operation).changes_scene) {
        journal.apply(call, progress);
      }
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw ParameterError("line " + std::to_string(number) + ": " + error.what());
    }
  }
}

}  // namespace espalier::viewer
