#pragma once

namespace vitrum {

/// CVODE's multistep methods: backward differences, Adams and Moulton.
enum class CvodeFamily { bdf, adams };

}  // namespace vitrum
