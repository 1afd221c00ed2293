// The rows of the table of methods, one function per file of this folder.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// `cage`: f = C b, the Cauchy-Green map of the posed cage (Weber, Ben-Chen, Gotsman 2009).
Method cage_method();

/// `pins`: the cage's map plus the smoothest holomorphic correction that takes pins to their
/// targets.
Method pins_method();

/// `arap`: triangles that keep their shape and size as well as they can.
Method arap_method();

/// `har_arap`: the same energy among smooth harmonic maps.
Method har_arap_method();

/// `outline`: the cage's shape onto a drawn outline (Segall, Ben-Chen 2016).
Method outline_method();

/// `strokes`: curves inside go onto other curves, free to slide (Segall, Ben-Chen 2016).
Method strokes_method();

/// `angles`: f' = exp(i H theta) for the boundary's angles (Weber, Gotsman 2010).
Method angles_method();

/// `harmonic`: f = h b, with harmonic coordinates h (Weber, Gotsman 2010, sec. 5): the cage's image
/// is the posed cage.
Method harmonic_method();

/// `mean_value`: the same with mean value coordinates.
Method mean_value_method();

/// `bounded`: the nearest locally injective map of bounded distortion to that of one of the others.
Method bounded_method(const std::vector<Method>& references);

}  // namespace holomorph
