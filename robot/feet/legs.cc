// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/legs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/tree.h"
#include "poise/robot/feet/leg_end.h"
#include "poise/robot/feet/leg_names.h"
#include "poise/robot/feet/no_feet.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A limb is at least this part of the longest chain. Arms and legs are, fingers
// and toes are not.
constexpr double kLimb = 0.25;
// More limbs are not compared, because the cost is quadratic in their number.
constexpr size_t kMostLimbs = 32;
// The following bounds are parts of the leg's length. kAlike: the shorter leg
// by the longer one. kTrunkAbove: the trunk's center of mass may be this far
// below the hips. kMirrored: distance from the mirror image of the other leg.
constexpr double kAlike = 0.7;
constexpr double kTrunkAbove = -0.15;
constexpr double kMirrored = 0.15;
// Two limbs whose hips are this near in height, and which end this near in
// height, both stand on the ground.
constexpr double kSameHips = 0.25;
constexpr double kSameGround = 0.1;
// The least cosine between a leg and the vertical, for z and for other axes.
// Some legs are bent at rest.
constexpr double kHangs = 0.5;
constexpr double kHangsSideways = 0.75;
// A leg is at least this part of its unfolded length high.
constexpr double kUnfolded = 0.3;

// Returns the axis of the root link along which a leg hangs down. A leg near
// the z axis hangs down along z.
std::optional<Vector3d> Upward(const Vector3d& leg) {
  if (-leg.z() >= kHangs * leg.norm() && leg.z() < 0) return Vector3d::UnitZ();
  int i = 0;
  const double most = leg.cwiseAbs().maxCoeff(&i);
  if (!(most > 0 && most >= kHangsSideways * leg.norm())) return std::nullopt;
  return Vector3d::Unit(i) * (leg[i] > 0 ? -1 : 1);
}

// A chain of joints that begins at the trunk.
struct Limb {
  int root;            // The first body.
  int tip;             // The last body along the longest path.
  double length;       // Length of the longest path, m.
  int word;            // 1: a leg by its names, -1: an arm, 0: unknown.
  std::string reason;  // Why it is no leg; empty if unknown.
};

struct Pair {
  Limb* limbs[2];
  Vector3d up_B;
  double length;
  std::tuple<bool, bool, double> rank;
};

class LegFinder {
 public:
  LegFinder(const RobotModel& model, const std::vector<Outline>& outlines,
            std::vector<Finding>* findings);

  Legs Find();

 private:
  void MeasureChains();
  void FindLimbs();
  Vector3d TrunkCenter(const Limb& a, const Limb& b, const Vector3d& up) const;
  std::optional<Pair> MakePair(Limb* a, Limb* b) const;
  bool MirrorEachOther(const Limb& a, const Limb& b, const Vector3d& up,
                       double length) const;
  int CountOnGround(const Pair& pair, const std::vector<double>& low) const;
  std::string WhyNoLegs() const;

  void Warn(std::string where, std::string what, std::string why) {
    if (findings_ == nullptr) return;
    findings_->push_back(
        {Severity::kWarn, std::move(where), std::move(what), std::move(why)});
  }

  // Returns whether a limb is the other limb, a part of it, or contains it.
  bool Overlap(const Limb& a, const Limb& b) const {
    return a.root < end_[b.root] && b.root < end_[a.root];
  }

  int Parent(int body) const { return tree_.joints()[body - 1].parent; }

  const RobotModel& model_;
  const Tree& tree_;
  const std::vector<Outline>& outlines_;
  std::vector<Finding>* findings_;
  std::vector<Pose> X_BB_;
  std::vector<int> end_;       // The body after each subtree.
  std::vector<double> reach_;  // The longest path in each subtree, m.
  std::vector<int> tip_;       // Its last body.
  std::vector<Limb> limbs_;
};

LegFinder::LegFinder(const RobotModel& model,
                     const std::vector<Outline>& outlines,
                     std::vector<Finding>* findings)
    : model_(model),
      tree_(model.tree),
      outlines_(outlines),
      findings_(findings),
      X_BB_(RestPoses(model)) {
  MeasureChains();
  FindLimbs();
}

void LegFinder::MeasureChains() {
  const int n = tree_.num_bodies();
  end_.resize(n);
  reach_.assign(n, 0);
  tip_.resize(n);
  for (int b = n - 1; b >= 0; --b) {
    end_[b] = std::max(end_[b], b + 1);
    if (reach_[b] == 0) tip_[b] = end_[b] - 1;
    if (b == 0) continue;
    const int parent = Parent(b);
    end_[parent] = std::max(end_[parent], end_[b]);
    // The origin of the base may be anywhere: it is no part of a limb.
    const double link = parent == 0 ? 0 : (X_BB_[b].p - X_BB_[parent].p).norm();
    const double length = link + reach_[b];
    if (length > reach_[parent]) {
      reach_[parent] = length;
      tip_[parent] = tip_[b];
    }
  }
}

void LegFinder::FindLimbs() {
  const int n = tree_.num_bodies();
  const double longest = *std::max_element(reach_.begin(), reach_.end());
  std::vector<int> branches(n, 0);
  for (int b = 1; b < n; ++b) {
    branches[Parent(b)] += reach_[b] > 0 && reach_[b] >= kLimb * longest;
  }
  for (int b = 1; b < n; ++b) {
    if (branches[Parent(b)] < 2 && Parent(b) > 0) continue;
    if (!(reach_[b] > 0 && reach_[b] >= kLimb * longest)) continue;
    limbs_.push_back({b, tip_[b], reach_[b], 0, ""});
  }
  if (limbs_.size() > kMostLimbs) {
    std::stable_sort(
        limbs_.begin(), limbs_.end(),
        [](const Limb& a, const Limb& b) { return a.length > b.length; });
    limbs_.resize(kMostLimbs);
  }
  std::vector<std::vector<int>> frames(n);
  for (size_t i = 0; i < tree_.frames().size(); ++i) {
    frames[tree_.frames()[i].body].push_back(static_cast<int>(i));
  }
  for (Limb& limb : limbs_) {
    int words = 0;
    for (int b = limb.tip; b >= limb.root; b = Parent(b)) {
      words += LegOrArm(tree_.joints()[b - 1].name);
      for (const int frame : frames[b]) {
        words += LegOrArm(tree_.frames()[frame].name);
      }
    }
    limb.word = words > 0 ? 1 : (words < 0 ? -1 : 0);
  }
}

// Returns the center of mass of the bodies that belong to neither of two limbs,
// nor to a limb beside them that also hangs down.
Vector3d LegFinder::TrunkCenter(const Limb& a, const Limb& b,
                                const Vector3d& up) const {
  std::vector<bool> in_leg(tree_.num_bodies(), false);
  for (const Limb& limb : limbs_) {
    const double rise = up.dot(X_BB_[limb.tip].p - X_BB_[limb.root].p);
    const bool hangs = rise < 0 && Parent(limb.root) == Parent(a.root);
    if (!hangs && &limb != &a && &limb != &b) continue;
    std::fill(in_leg.begin() + limb.root, in_leg.begin() + end_[limb.root],
              true);
  }
  for (const bool all : {false, true}) {
    Vector3d sum = Vector3d::Zero();
    double mass = 0;
    for (int i = 0; i < tree_.num_bodies(); ++i) {
      if (in_leg[i] && !all) continue;
      const auto& M = tree_.inertias()[i];
      sum += M.mass * (X_BB_[i] * M.p_BoG_B);
      mass += M.mass;
    }
    if (mass > 0.01 * tree_.total_mass()) return sum / mass;
  }
  return X_BB_[0].p;
}

bool LegFinder::MirrorEachOther(const Limb& a, const Limb& b,
                                const Vector3d& up, double length) const {
  const Vector3d hips = X_BB_[a.root].p - X_BB_[b.root].p;
  const Vector3d tips = X_BB_[a.tip].p - X_BB_[b.tip].p;
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = Vector3d::Unit(i);
    if (std::abs(axis.dot(up)) > 0.5) continue;
    const auto off = [&](const Vector3d& apart) {
      return (apart - apart.dot(axis) * axis).norm();
    };
    if (std::max(off(hips), off(tips)) <= kMirrored * length) return true;
  }
  return false;
}

std::optional<Pair> LegFinder::MakePair(Limb* a, Limb* b) const {
  const auto reject = [&](const char* reason) {
    for (Limb* limb : {a, b}) {
      if (limb->reason.empty()) limb->reason = reason;
    }
    return std::nullopt;
  };
  if (Parent(a->root) != Parent(b->root)) return std::nullopt;
  for (Limb* limb : {a, b}) {
    if (limb->word < 0) limb->reason = "is an arm by its names";
  }
  if (a->word < 0 || b->word < 0) return std::nullopt;
  const auto [shorter, longer] = std::minmax(a->length, b->length);
  if (shorter < kAlike * longer) return reject("has another length");

  const Vector3d hips = 0.5 * (X_BB_[a->root].p + X_BB_[b->root].p);
  const Vector3d leg = 0.5 * (X_BB_[a->tip].p + X_BB_[b->tip].p) - hips;
  const auto upward = Upward(leg);
  const double length = upward ? -leg.dot(*upward) : 0;
  if (!(length >= kUnfolded * longer)) {
    return reject("does not hang down at rest");
  }
  const Vector3d up = *upward;
  const bool named = a->word > 0 && b->word > 0;
  const bool upright = up == Vector3d::UnitZ();
  if (!named) {
    const double above = (TrunkCenter(*a, *b, up) - hips).dot(up);
    // A tilted root link is rare, so the trunk must be clearly above the legs.
    if (above < (upright ? kTrunkAbove : -kTrunkAbove) * length) {
      return reject("begins above the trunk's center of mass, as an arm does");
    }
    if (!MirrorEachOther(*a, *b, up, length)) {
      return reject("has no mirror image");
    }
  }
  return Pair{{a, b}, up, length, {named, upright, -hips.dot(up)}};
}

// Returns the number of limbs, besides arms, that end as low as the pair.
int LegFinder::CountOnGround(const Pair& pair,
                             const std::vector<double>& low) const {
  const auto lowest = [&](const Limb& limb) {
    return *std::min_element(low.begin() + limb.root,
                             low.begin() + end_[limb.root]);
  };
  const auto height = [&](const Limb& limb) {
    return pair.up_B.dot(X_BB_[limb.root].p);
  };
  const Limb& a = *pair.limbs[0];
  const Limb& b = *pair.limbs[1];
  const double ground = std::max(lowest(a), lowest(b));
  const double hips = 0.5 * (height(a) + height(b));
  int count = 2;
  for (const Limb& limb : limbs_) {
    if (limb.word < 0 || Overlap(limb, a) || Overlap(limb, b)) continue;
    count += std::abs(height(limb) - hips) <= kSameHips * pair.length &&
             lowest(limb) <= ground + kSameGround * pair.length;
  }
  return count;
}

std::string LegFinder::WhyNoLegs() const {
  constexpr size_t kMost = 4;
  std::string text;
  for (size_t i = 0; i < limbs_.size() && i < kMost; ++i) {
    const Limb& limb = limbs_[i];
    text += (i > 0 ? "; " : "") + Quoted(LinkOf(model_, limb.root)) + " " +
            (limb.reason.empty() ? "has no mirror image" : limb.reason);
  }
  if (limbs_.empty()) text = "no limb has two joints or more";
  if (limbs_.size() > kMost) {
    text += "; and " + std::to_string(limbs_.size() - kMost) + " more";
  }
  return text;
}

Legs LegFinder::Find() {
  const std::string robot = "robot " + Quoted(model_.name);
  std::vector<Pair> pairs;
  for (size_t i = 0; i < limbs_.size(); ++i) {
    for (size_t j = i + 1; j < limbs_.size(); ++j) {
      const auto pair = MakePair(&limbs_[i], &limbs_[j]);
      if (pair) pairs.push_back(*pair);
    }
  }
  // Rods and other branches within the legs of another pair are no legs.
  const auto is_within = [&](const Pair& inner, const Pair& outer) {
    const int root = inner.limbs[0]->root;
    return std::any_of(outer.limbs, outer.limbs + 2, [&](const Limb* limb) {
      return root > limb->root && root < end_[limb->root];
    });
  };
  std::optional<Pair> best;
  for (const Pair& pair : pairs) {
    const bool is_part =
        std::any_of(pairs.begin(), pairs.end(),
                    [&](const Pair& outer) { return is_within(pair, outer); });
    if (!is_part && (!best || pair.rank > best->rank)) best = pair;
  }
  if (!best) {
    throw std::invalid_argument(robot + " has no two legs (" + WhyNoLegs() +
                                "), must have two feet: give the feet in a "
                                "profile");
  }
  const Vector3d& up = best->up_B;
  const auto low = LowestPoints(model_, outlines_, X_BB_, up);
  const int count = CountOnGround(*best, low);
  if (count != 2) {
    throw NoFeet(FeetDefect::kManyLegs,
                 robot + " reaches the ground with " + std::to_string(count) +
                     " bodies, must be two feet: quadrupeds are not supported; "
                     "if only two bodies are feet, give them in a profile");
  }
  Legs legs{{}, {}, up, best->length};
  for (const int i : {0, 1}) {
    legs.hips[i] = best->limbs[i]->root;
    const LegEnd end =
        FindLegEnd(model_, X_BB_, low, legs.hips[i], up, best->length);
    legs.feet[i] = end.foot;
    for (const int toe : end.toes) {
      Warn("joint " + Quoted(tree_.joints()[toe].name),
           "moves toes in front of foot " + Quoted(LinkOf(model_, end.foot)),
           "a foot is one rigid sole here: lock the joint in a profile "
           "(locked: {" +
               tree_.joints()[toe].name + ": 0})");
    }
  }
  return legs;
}

}  // namespace

std::string LinkOf(const RobotModel& model, int body) {
  for (const Frame& frame : model.tree.frames()) {
    if (frame.body == body) return frame.name;
  }
  return "";
}

std::vector<Pose> RestPoses(const RobotModel& model) {
  std::vector<Pose> X_BB(model.tree.num_bodies());
  ComputePoses(model.tree, RestConfiguration(model), &X_BB);
  return X_BB;
}

Legs FindLegs(const RobotModel& model, const std::vector<Outline>& outlines,
              std::vector<Finding>* findings) {
  return LegFinder(model, outlines, findings).Find();
}

Legs FindLegsOf(const RobotModel& model, const std::array<int, 2>& feet) {
  const std::vector<Pose> X_BB = RestPoses(model);
  // The hips are the last bodies, seen from the feet, before the two chains
  // meet. A parent has a smaller index.
  std::array<int, 2> hips = feet;
  std::array<int, 2> at = feet;
  while (at[0] != at[1]) {
    const int i = at[0] > at[1] ? 0 : 1;
    hips[i] = at[i];
    at[i] = model.tree.joints()[at[i] - 1].parent;
  }
  Vector3d leg = Vector3d::Zero();
  for (const int i : {0, 1}) {
    if (at[0] == feet[i]) {
      throw std::invalid_argument("link " + Quoted(LinkOf(model, feet[i])) +
                                  " carries the other foot, must be at the "
                                  "end of another leg");
    }
    leg += 0.5 * (X_BB[feet[i]].p - X_BB[hips[i]].p);
  }
  const auto up = Upward(leg);
  if (!up) {
    throw std::invalid_argument(
        "the legs of the two feet do not hang down along an axis of the root "
        "link at rest: give the feet in a profile");
  }
  return {hips, feet, *up, -leg.dot(*up)};
}

}  // namespace poise
