// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/projected_rows.h"

#include <algorithm>

#include "poise/hqp/fast/kernels.h"

namespace poise {

ProjectedRows::ProjectedRows(int num_variables, int num_keys, int max_rows)
    : n_(num_variables),
      stride_((num_variables + 3) / 4 * 4),
      max_rows_(max_rows),
      slot_stride_((max_rows + 3) / 4 * 4),
      slot_(num_keys, -1),
      key_(max_rows),
      is_used_(max_rows),
      remainder_(Index(max_rows, stride_)),
      l_(Index(num_variables, slot_stride_)),
      factor_(max_rows) {}

void ProjectedRows::Clear(int rank) {
  for (int slot = 0; slot < size_; ++slot) slot_[key_[slot]] = -1;
  size_ = 0;
  rank_ = rank;
}

bool ProjectedRows::Add(int key, const double* coefficients,
                        const double* remainder) {
  if (size_ == max_rows_) return false;
  const int slot = size_++;
  slot_[key] = slot;
  key_[slot] = key;
  is_used_[slot] = true;
  std::copy_n(remainder, n_, this->remainder(slot));
  for (int e = 0; e < rank_; ++e) this->coefficients(e)[slot] = coefficients[e];
  return true;
}

bool ProjectedRows::Use(int key, double* coefficients, double* remainder) {
  const int slot = slot_[key];
  if (slot < 0) return false;
  is_used_[slot] = true;
  std::copy_n(this->remainder(slot), n_, remainder);
  for (int e = 0; e < rank_; ++e) coefficients[e] = this->coefficients(e)[slot];
  return true;
}

void ProjectedRows::KeepUsed() {
  for (int slot = size_ - 1; slot >= 0; --slot) {
    if (is_used_[slot]) continue;
    // The last row takes the place of the removed one.
    const int last = --size_;
    slot_[key_[slot]] = -1;
    if (slot == last) continue;
    key_[slot] = key_[last];
    is_used_[slot] = true;
    slot_[key_[slot]] = slot;
    std::copy_n(remainder(last), n_, remainder(slot));
    for (int e = 0; e < rank_; ++e)
      coefficients(e)[slot] = coefficients(e)[last];
  }
  std::fill_n(is_used_.begin(), size_, false);
}

void ProjectedRows::Extend(const double* q, int columns) {
  double* l = coefficients(rank_++);
  kernels::Dots(remainder_.data(), stride_, size_, q, columns, l);
  for (int slot = 0; slot < size_; ++slot) factor_[slot] = -l[slot];
  kernels::AddToRows(remainder_.data(), stride_, size_, factor_.data(), q,
                     columns);
}

void ProjectedRows::Rotate(int e, double c, double s) {
  kernels::Rotate(c, s, size_, coefficients(e), coefficients(e + 1));
}

void ProjectedRows::RemoveLast(const double* q, int columns) {
  kernels::AddToRows(remainder_.data(), stride_, size_, coefficients(--rank_),
                     q, columns);
}

void ProjectedRows::Swap(int e, int f) {
  std::swap_ranges(coefficients(e), coefficients(e) + size_, coefficients(f));
}

void ProjectedRows::Negate(int e) {
  double* l = coefficients(e);
  for (int slot = 0; slot < size_; ++slot) l[slot] = -l[slot];
}

void ProjectedRows::MoveColumn(int from, int to) {
  for (int slot = 0; slot < size_; ++slot)
    remainder(slot)[to] = remainder(slot)[from];
}

void ProjectedRows::SetZero(int column) {
  for (int slot = 0; slot < size_; ++slot) remainder(slot)[column] = 0;
}

}  // namespace poise
