#include "inslab/formats/recordings/kml.hpp"

#include <stdexcept>

#include "inslab/foundation/files/text_writer.hpp"
#include "inslab/foundation/files/xml_text.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {

namespace {

/// Longitude, latitude in degrees (9 decimals: 0.1 mm), height in m.
void put_point(files::TextWriter& out, const nav::Geodetic& point) {
  out.number(point.longitude_rad / units::kDeg, 9).number(point.latitude_rad / units::kDeg, 9);
  out.number(point.height_m, 3).end_line();
}

void put(files::TextWriter& out, const std::string& line) { out.text(line).end_line(); }

void put_line(files::TextWriter& out, const std::string& name, const std::string& mode, const std::string& style,
              const std::vector<nav::Geodetic>& points) {
  put(out, "<Placemark><name>" + name + "</name><styleUrl>#" + style + "</styleUrl><LineString><tessellate>1" +
               "</tessellate><altitudeMode>" + mode + "</altitudeMode><coordinates>");
  for (const nav::Geodetic& point : points) put_point(out, point);
  put(out, "</coordinates></LineString></Placemark>");
}

void put_end(files::TextWriter& out, const std::string& name, const nav::Geodetic& point) {
  put(out, "<Placemark><name>" + name + "</name><Point><altitudeMode>clampToGround</altitudeMode><coordinates>");
  put_point(out, point);
  put(out, "</coordinates></Point></Placemark>");
}

}  // namespace

void KmlTrack::add(const nav::Geodetic& position) {
  last_ = position;
  if (added_++ % every_ != 0) return;
  points_.push_back(position);
  if (points_.size() < kMaxPoints) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
  points_.resize(kept);
  every_ *= 2;
}

void KmlTrack::write(const std::string& path, const std::string& name) const {
  if (points_.empty()) throw std::logic_error("a track without points");
  std::vector<nav::Geodetic> points = points_;
  if ((added_ - 1) % every_ != 0) points.push_back(last_);
  files::TextWriter out(path, ",");
  put(out, R"(<?xml version="1.0" encoding="UTF-8"?>)");
  put(out, R"(<kml xmlns="http://www.opengis.net/kml/2.2"><Document>)");
  put(out, "<name>" + files::xml_text(name) + "</name>");
  put(out, R"(<Style id="track"><LineStyle><color>ff0000ff</color><width>3</width></LineStyle></Style>)");
  put(out, R"(<Style id="ground"><LineStyle><color>ff00ffff</color><width>2</width></LineStyle></Style>)");
  put_line(out, "track, heights above the ellipsoid", "absolute", "track", points);
  put_line(out, "on the ground", "clampToGround", "ground", points);
  put_end(out, "start", points.front());
  put_end(out, "end", points.back());
  put(out, "</Document></kml>");
  out.close();
}

}  // namespace inslab::recordings
