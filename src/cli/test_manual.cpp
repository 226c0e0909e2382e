// SPDX-License-Identifier: MIT
#include "cli/manuals.h"

namespace plumb {

std::string_view test_manual()
{
    return R"(
Runs the test files of the courses, which have <test> for their root, unchanged.

  <test type="ttest"> compares means with references by Student's t-test: of
      each <scene>, the luminance of the light that arrives at random places of
      the film (no filter); or of each <bsdf>, for each of the `angles` between
      wi and the normal in degrees, the luminance of the weights of its samples;
      or of each <emitter> that needs no shape, for each of the `distances` d, the
      luminance of what arrives at (0, 0, d) from it over the density of samples.
      `references` holds one number for each scene, or for each angle of each
      bsdf, bsdf by bsdf, or for each distance of each emitter. sampleCount
      (100000), significanceLevel (0.01).
  <test type="chi2test"> compares the samples of each <bsdf> with its density by
      Pearson's chi-square test on a grid of cos theta x phi, `resolution` (10)
      by twice as many cells, for testCount (5) random directions wi. Cells that
      expect fewer than minExpFrequency (5) samples are pooled. sampleCount (-1:
      5000 a cell), significanceLevel (0.01).

The p-values are those of the courses' statistic, and the level of each test is
Sidak's share of significanceLevel. In these details this program is stricter or
clearer: a sample that is not finite rejects, a black sample counts as one in a
chi2test (one that the bsdf refuses does not), and the scenes' own samplers and
sampleCount are not used.

A test that rejects is repeated once with 100 times the samples and independent
random numbers; both results are printed, and the second one counts. A t-test
assumes a finite variance. Where emitting walls touch, as in a closed box,
next-event estimation has none: samples near the edges are rare and huge,
and the plain t-test rejects correct code several times more often than its
level says. A bias stays when the noise falls to a tenth; such a rejection
usually does not. So a correct renderer seldom fails here, and a mean that is
off by five standard errors always fails. The test cannot detect what is smaller
than the noise of sampleCount samples.

Scenes of a ttest are read in one dialect: that of --dialect, else that of the
attribute of <scene> or <test>, else the one that the file indicates. Only EPFL
and ETH files have ttests, so emitters scatter light unless something indicates
otherwise. The same seed gives the same results for any number of threads.

All files are read before the first test runs. Exit codes: 0 all tests passed,
3 a test failed, 1 a file is wrong, 2 wrong usage.
)";
}

} // namespace plumb
