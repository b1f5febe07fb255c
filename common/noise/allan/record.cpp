#include "inslab/noise/allan/record.hpp"

#include <cmath>
#include <stdexcept>

namespace inslab::allan {

Record::Record(double dt_s, std::size_t max_clusters) : dt_s_(dt_s), max_clusters_(max_clusters) {
  if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("record: the interval is not above 0 s");
  if (max_clusters == 0 || max_clusters % 2 != 0) throw std::invalid_argument("record: clusters are merged in pairs");
}

void Record::add(double increment) {
  if (samples_ == 0) first_ = increment;
  double sum = increment - first_;
  total_ += sum;
  const std::int64_t index = samples_++;
  for (std::size_t l = 0; l < details_.size(); ++l) {
    if (((index >> l) & 1) == 0) {
      pending_[l] = sum;
      return;
    }
    const double difference = sum - pending_[l];
    details_[l].squares += difference * difference;
    ++details_[l].count;
    sum += pending_[l];
  }
  clusters_.push_back(sum);
  if (clusters_.size() == max_clusters_) merge();
}

void Record::merge() {
  Details details;
  for (std::size_t i = 0; i < max_clusters_ / 2; ++i) {
    const double difference = clusters_[2 * i + 1] - clusters_[2 * i];
    details.squares += difference * difference;
    ++details.count;
    clusters_[i] = clusters_[2 * i] + clusters_[2 * i + 1];
  }
  clusters_.resize(max_clusters_ / 2);
  details_.push_back(details);
  pending_.push_back(0.0);
}

double Record::mean() const { return samples_ == 0 ? 0.0 : (first_ + total_ / static_cast<double>(samples_)) / dt_s_; }

std::vector<double> Record::cluster_means() const {
  std::vector<double> means = clusters_;
  for (double& mean : means) mean /= static_cast<double>(samples_per_cluster()) * dt_s_;
  return means;
}

}  // namespace inslab::allan
