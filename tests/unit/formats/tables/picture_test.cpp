#include "inslab/formats/tables/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace inslab::tables {
namespace picture_test {

using testing::HasSubstr;
using testing::StartsWith;

Picture two_panels() {
  Picture picture;
  picture.title = "it's a test";
  Panel line, gap;
  line.title = "line";
  line.curves = {{"rising", {0.0, 1.0, 2.0}, {0.0, 1.0, 4.0}}};
  line.equal_scales = true;
  gap.title = "gap";
  gap.curves = {{"", {0.0, 1.0, 2.0}, {1.0, std::nan(""), 3.0}}};
  picture.panels = {line, gap};
  return picture;
}

TEST(GnuplotScript, HasDataAndAPlotForEveryPanelWithTextsThatAreNoMarkup) {
  const std::string script = gnuplot_script(two_panels(), PictureFormat::Svg);
  EXPECT_THAT(script, HasSubstr("title 'it''s a test'"));
  EXPECT_THAT(script, HasSubstr("plot $curve0 with lines title 'rising'"));
  EXPECT_THAT(script, HasSubstr("plot $curve1 with lines notitle"));
  EXPECT_THAT(script, HasSubstr("0 1\n\n2 3\n"));  // the NaN is an empty line, which interrupts
  EXPECT_THAT(script, HasSubstr("noenhanced"));
}

TEST(GnuplotScript, ShadesBandsAndMarksOfTheirOwnPanelAlone) {
  Picture picture = two_panels();
  picture.panels[0].bands = {{0.5, 1.5}};
  picture.panels[0].marks = {1.25};
  const std::string script = gnuplot_script(picture, PictureFormat::Svg);
  const std::size_t band = script.find("rectangle from first 0.5, graph 0 to first 1.5, graph 1 behind");
  const std::size_t mark = script.find("arrow from first 1.25, graph 0 to first 1.25, graph 1 nohead");
  const std::size_t first = script.find("plot $curve0"), second = script.find("plot $curve1");
  EXPECT_LT(band, first);
  EXPECT_LT(mark, first);
  const std::size_t cleared = script.find("unset object\nunset arrow", first);
  EXPECT_LT(first, cleared);
  EXPECT_LT(cleared, second);
}

TEST(GnuplotScript, EndsATightPanelAtItsDataAndLeavesOutWhatIsNotWanted) {
  Picture picture = two_panels();
  picture.title = "";
  picture.panels[0].tight_x = true;
  picture.panels[1].has_key = false;
  const std::string script = gnuplot_script(picture, PictureFormat::Svg);
  const std::size_t first = script.find("plot $curve0");
  EXPECT_LT(script.find("set autoscale xfix"), first);
  EXPECT_LT(script.find("set key on"), first);
  EXPECT_NE(script.find("set autoscale x\n", first), std::string::npos);
  EXPECT_NE(script.find("unset key", first), std::string::npos);
  EXPECT_THAT(script, HasSubstr("set multiplot layout 2,1\n"));
}

TEST(Thinned, ByLogarithmKeepsWhatIsSmall) {
  Curve curve;
  for (int i = 0; i < 100; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 10 ? 1e-3 : i == 20 ? 0.0 : i < 50 ? 1e-2 : 1e3);
  }
  const Curve kept = thinned_by_logarithm(curve, 400);
  EXPECT_DOUBLE_EQ(*std::min_element(kept.y.begin(), kept.y.end()), 1e-3);
  EXPECT_LT(kept.x.size(), 10u);
}

TEST(TicStep, IsARoundNumber) {
  EXPECT_DOUBLE_EQ(tic_step_over(2700.0), 500.0);
  EXPECT_DOUBLE_EQ(tic_step_over(0.9), 0.2);
  EXPECT_DOUBLE_EQ(tic_step_over(4.0), 1.0);
}

TEST(Picture, IsDrawnByGnuplot) {
  try {
    EXPECT_THAT(drawn(two_panels(), PictureFormat::Png), StartsWith("\x89PNG"));
    const std::string svg = drawn(two_panels(), PictureFormat::Svg);
    EXPECT_THAT(svg, HasSubstr("<svg"));
    EXPECT_THAT(svg, HasSubstr("rising"));
    EXPECT_EQ(svg, drawn(two_panels(), PictureFormat::Svg));
  } catch (const PictureError& error) {
    if (std::string(error.what()).find("cannot be run") == std::string::npos) throw;
    GTEST_SKIP() << error.what();
  }
}

TEST(Picture, WithoutGnuplotSaysWhatIsMissing) {
  try {
    drawn(two_panels(), PictureFormat::Svg, "no-such-gnuplot");
    FAIL() << "was drawn";
  } catch (const PictureError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no-such-gnuplot cannot be run: No such file or directory"));
    EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
  }
}

TEST(Picture, SaysWhatTheProgramSaidWhenItFails) {
  // A program that takes the script as its own and fails on it.
  try {
    drawn(two_panels(), PictureFormat::Svg, "false");
    FAIL() << "was drawn";
  } catch (const PictureError& error) {
    EXPECT_THAT(error.what(), HasSubstr("false drew nothing"));
  }
}

TEST(ThinnedCurve, KeepsTheExtremesOfEveryBinInOrder) {
  Curve curve;
  for (int i = 0; i < 10000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 4321 ? 7.0 : std::sin(0.3 * i));
  }
  const Curve kept = thinned(curve, 100);
  EXPECT_LE(kept.x.size(), 200u);
  EXPECT_GE(kept.x.size(), 190u);
  EXPECT_TRUE(std::is_sorted(kept.x.begin(), kept.x.end()));
  EXPECT_NE(std::find(kept.y.begin(), kept.y.end(), 7.0), kept.y.end());
  EXPECT_EQ(thinned(two_panels().panels[0].curves[0], 100).x.size(), 3u);
}

TEST(ThinnedCurve, LeavesOutWhatLiesOnAStraightLine) {
  Curve ramp;
  for (int i = 0; i < 1000; ++i) {
    ramp.x.push_back(i);
    ramp.y.push_back(i < 500 ? 0.0 : i - 500.0);
  }
  const Curve kept = thinned(ramp, 100);
  EXPECT_LE(kept.x.size(), 5u);
  EXPECT_EQ(kept.x.front(), 0.0);
  EXPECT_EQ(kept.x.back(), 999.0);
  for (std::size_t i = 1; i < kept.x.size(); ++i) {
    for (double x = kept.x[i - 1]; x <= kept.x[i]; x += 1.0) {
      const double share = (x - kept.x[i - 1]) / (kept.x[i] - kept.x[i - 1]);
      // A two-thousandth of the height, and what a bin of ten points may miss of the corner in its middle.
      EXPECT_NEAR(kept.y[i - 1] + share * (kept.y[i] - kept.y[i - 1]), std::max(0.0, x - 500.0), 499.0 / 2000.0 + 5.0);
    }
  }
}

TEST(ThinnedTrack, KeepsPointsThatAreApartAndTheLast) {
  Curve track;
  for (int i = 0; i <= 1005; ++i) {
    track.x.push_back(0.01 * i);
    track.y.push_back(0.0);
  }
  const Curve kept = thinned_by_distance(track, 0.095, 1000);
  // Every tenth, 0.1 apart, and the last one.
  EXPECT_EQ(kept.x.size(), 102u);
  EXPECT_EQ(kept.x.back(), track.x.back());
  EXPECT_LE(thinned_by_distance(track, 0.095, 60).x.size(), 60u);
}

}  // namespace picture_test
}  // namespace inslab::tables
