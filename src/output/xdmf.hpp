#pragma once
#include <string>
#include <vector>

#include "output/drawing.hpp"

namespace vitrum::output {

/// The XDMF of one output: a collection of a block per body, whose points are its particles. The data are
/// those of steps/NNNNN.h5 below /drawn.
///
/// All three XDMF readers of ParaView (XDMF, Xdmf3ReaderS, Xdmf3ReaderT) read it. Two of them know neither
/// functions nor hyperslabs, so that vectors, tensors and blocks are arrays of their own; draw no points that
/// are not listed; and take the six components of `Tensor6` in another order than the third: so tensors are
/// matrices of six columns, which VTK takes for symmetric tensors in its own order.
std::string step_xdmf(std::size_t index, double time, const std::vector<DrawnBody>& bodies);

/// result.xdmf: the outputs `drawn` as a time series. It includes their files, so that an output adds one
/// line.
std::string xdmf_text(const std::vector<std::size_t>& drawn);

}  // namespace vitrum::output
