// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/frame.h"

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {

FrameTask::FrameTask(const std::string& name, int tick_frame, int index)
    : Task("frame." + name, FrameRows(name), {}),
      tick_frame_(tick_frame),
      index_(index) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
  AddParameter("orientation", &orientation_, 0, 1);
  AddParameter("position", &position_, 0, 1);
}

void FrameTask::Write(const TaskInput& input, EqualityBlock* equalities,
                      InequalityBlock*) const noexcept {
  const FrameTick& frame = input.tick.frames[tick_frame_];
  const FrameReference& reference = input.reference.frames[index_];
  Vector6d e;
  e << LogSo3(reference.X_WF.R * frame.X_WF.R.transpose()),
      reference.X_WF.p - frame.X_WF.p;
  const Vector6d wanted =
      reference.A_WF_W + kd_ * (reference.V_WF_W - frame.V_WF_W) + kp_ * e;
  const auto nv = frame.J_WF_W.cols();
  const auto write = [&](int row) {
    equalities->B.block(row, 0, 3, nv) = frame.J_WF_W.middleRows<3>(row);
    equalities->b.segment<3>(row) =
        frame.Jdot_v.segment<3>(row) - wanted.segment<3>(row);
  };
  if (orientation_ > 0.5) write(0);
  if (position_ > 0.5) write(3);
}

}  // namespace poise
