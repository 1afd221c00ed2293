// The rows of the table of methods. Each method has one function and one file in this folder.
#pragma once

#include "core/maps/method.h"

namespace holomorph {

/// `cage`: f = C b, the Cauchy-Green map of the posed cage (Weber, Ben-Chen, Gotsman 2009).
Method cage_method();

/// `pins`: the cage's map plus the smoothest holomorphic correction that takes the pins to their
/// targets.
Method pins_method();

/// `arap`: triangles keep their shape and size as far as possible.
Method arap_method();

/// `har_arap`: minimizes the energy of `arap` over smooth harmonic maps.
Method har_arap_method();

/// `outline`: maps the cage's shape onto a drawn outline (Segall, Ben-Chen 2016).
Method outline_method();

/// `strokes`: maps curves inside the cage onto other curves. Points may slide along the curves
/// (Segall, Ben-Chen 2016).
Method strokes_method();

/// `angles`: f' = exp(i H theta) for boundary angles theta (Weber, Gotsman 2010).
Method angles_method();

/// `harmonic`: f = h b, with harmonic coordinates h (Weber, Gotsman 2010, sec. 5). The image of the
/// cage is the posed cage.
Method harmonic_method();

/// `mean_value`: f = h b, with mean value coordinates h.
Method mean_value_method();

/// `bounded`: finds the locally injective map of bounded distortion that is nearest to another
/// method's map (Levi, Weber 2016). By default, it follows the method `usual_id`.
Method bounded_method(const std::vector<Method>& references, const std::string& usual_id);

/// `puppet`: keeps sizes and shapes as far as possible, and never folds.
Method puppet_method();

/// `sheet`: an elastic sheet that resists changes of size and bending, and never folds. What is far
/// from the handles that move stays.
Method sheet_method();

}  // namespace holomorph
