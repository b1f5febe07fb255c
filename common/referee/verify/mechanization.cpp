#include "inslab/referee/verify/mechanization.hpp"

namespace inslab::verify {

namespace {

class ProductMechanization final : public Mechanization {
 public:
  explicit ProductMechanization(const nav::Strapdown& strapdown) : strapdown_(strapdown) {}

  void advance(const nav::ImuIncrements& imu) override { strapdown_.advance(imu); }
  void hold_vertical(double height_m, double v_d_m_per_s) override { strapdown_.hold_vertical(height_m, v_d_m_per_s); }
  nav::NavState state() const override { return strapdown_.state(); }

 private:
  nav::Strapdown strapdown_;
};

}  // namespace

std::unique_ptr<Mechanization> product_mechanization(const nav::NavState& start, const nav::Gravity& gravity,
                                                     const nav::Strapdown::Options& options,
                                                     const std::optional<nav::ImuIncrements>& before) {
  return std::make_unique<ProductMechanization>(nav::Strapdown(start, gravity, options, before));
}

}  // namespace inslab::verify
