/* The sensitivity functions of every drive. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
#include "cylindrical_worm_za_za_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
#include "cylindrical_worm_za_zi_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
#include "cylindrical_worm_za_zn_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
#include "cylindrical_worm_za_zk_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
#include "cylindrical_worm_za_zc_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
#include "cylindrical_worm_zi_za_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
#include "cylindrical_worm_zi_zi_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
#include "cylindrical_worm_zi_zn_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
#include "cylindrical_worm_zi_zk_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
#include "cylindrical_worm_zi_zc_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
#include "cylindrical_worm_zn_za_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
#include "cylindrical_worm_zn_zi_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
#include "cylindrical_worm_zn_zn_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
#include "cylindrical_worm_zn_zk_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
#include "cylindrical_worm_zn_zc_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
#include "cylindrical_worm_zk_za_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
#include "cylindrical_worm_zk_zi_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
#include "cylindrical_worm_zk_zn_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
#include "cylindrical_worm_zk_zk_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
#include "cylindrical_worm_zk_zc_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
#include "cylindrical_worm_zc_za_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
#include "cylindrical_worm_zc_zi_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
#include "cylindrical_worm_zc_zn_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
#include "cylindrical_worm_zc_zk_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
#include "cylindrical_worm_zc_zc_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
#include "spherical_convex_convex_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
#include "spherical_convex_concave_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
#include "spherical_convex_spur_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
#include "spherical_concave_convex_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
#include "spherical_concave_concave_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
#include "spherical_concave_spur_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
#include "spherical_spur_convex_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
#include "spherical_spur_concave_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
#include "spherical_spur_spur_sensitivity.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
#include "face_worm_sensitivity.h"
#endif

#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
static const mw_system_tangents face_worm_system_tangents[] = {
    { face_worm_pitch_point_tangent, face_worm_pitch_point_fill_tangent },
    { face_worm_inner_point_tangent, face_worm_inner_point_fill_tangent },
    { face_worm_outer_point_tangent, face_worm_outer_point_fill_tangent },
};
#endif
static const mw_tangents mw_tangent_models[] = {
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
    { "cylindrical_worm_za_za", cylindrical_worm_za_za_derive_tangent, NULL, cylindrical_worm_za_za_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
    { "cylindrical_worm_za_zi", cylindrical_worm_za_zi_derive_tangent, NULL, cylindrical_worm_za_zi_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
    { "cylindrical_worm_za_zn", cylindrical_worm_za_zn_derive_tangent, NULL, cylindrical_worm_za_zn_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
    { "cylindrical_worm_za_zk", cylindrical_worm_za_zk_derive_tangent, NULL, cylindrical_worm_za_zk_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
    { "cylindrical_worm_za_zc", cylindrical_worm_za_zc_derive_tangent, NULL, cylindrical_worm_za_zc_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
    { "cylindrical_worm_zi_za", cylindrical_worm_zi_za_derive_tangent, NULL, cylindrical_worm_zi_za_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
    { "cylindrical_worm_zi_zi", cylindrical_worm_zi_zi_derive_tangent, NULL, cylindrical_worm_zi_zi_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
    { "cylindrical_worm_zi_zn", cylindrical_worm_zi_zn_derive_tangent, NULL, cylindrical_worm_zi_zn_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
    { "cylindrical_worm_zi_zk", cylindrical_worm_zi_zk_derive_tangent, NULL, cylindrical_worm_zi_zk_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
    { "cylindrical_worm_zi_zc", cylindrical_worm_zi_zc_derive_tangent, NULL, cylindrical_worm_zi_zc_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
    { "cylindrical_worm_zn_za", cylindrical_worm_zn_za_derive_tangent, NULL, cylindrical_worm_zn_za_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
    { "cylindrical_worm_zn_zi", cylindrical_worm_zn_zi_derive_tangent, NULL, cylindrical_worm_zn_zi_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
    { "cylindrical_worm_zn_zn", cylindrical_worm_zn_zn_derive_tangent, NULL, cylindrical_worm_zn_zn_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
    { "cylindrical_worm_zn_zk", cylindrical_worm_zn_zk_derive_tangent, NULL, cylindrical_worm_zn_zk_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
    { "cylindrical_worm_zn_zc", cylindrical_worm_zn_zc_derive_tangent, NULL, cylindrical_worm_zn_zc_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
    { "cylindrical_worm_zk_za", cylindrical_worm_zk_za_derive_tangent, NULL, cylindrical_worm_zk_za_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
    { "cylindrical_worm_zk_zi", cylindrical_worm_zk_zi_derive_tangent, NULL, cylindrical_worm_zk_zi_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
    { "cylindrical_worm_zk_zn", cylindrical_worm_zk_zn_derive_tangent, NULL, cylindrical_worm_zk_zn_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
    { "cylindrical_worm_zk_zk", cylindrical_worm_zk_zk_derive_tangent, NULL, cylindrical_worm_zk_zk_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
    { "cylindrical_worm_zk_zc", cylindrical_worm_zk_zc_derive_tangent, NULL, cylindrical_worm_zk_zc_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
    { "cylindrical_worm_zc_za", cylindrical_worm_zc_za_derive_tangent, NULL, cylindrical_worm_zc_za_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
    { "cylindrical_worm_zc_zi", cylindrical_worm_zc_zi_derive_tangent, NULL, cylindrical_worm_zc_zi_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
    { "cylindrical_worm_zc_zn", cylindrical_worm_zc_zn_derive_tangent, NULL, cylindrical_worm_zc_zn_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
    { "cylindrical_worm_zc_zk", cylindrical_worm_zc_zk_derive_tangent, NULL, cylindrical_worm_zc_zk_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
    { "cylindrical_worm_zc_zc", cylindrical_worm_zc_zc_derive_tangent, NULL, cylindrical_worm_zc_zc_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
    { "spherical_convex_convex", spherical_convex_convex_derive_tangent, NULL, spherical_convex_convex_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
    { "spherical_convex_concave", spherical_convex_concave_derive_tangent, NULL, spherical_convex_concave_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
    { "spherical_convex_spur", spherical_convex_spur_derive_tangent, NULL, spherical_convex_spur_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
    { "spherical_concave_convex", spherical_concave_convex_derive_tangent, NULL, spherical_concave_convex_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
    { "spherical_concave_concave", spherical_concave_concave_derive_tangent, NULL, spherical_concave_concave_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
    { "spherical_concave_spur", spherical_concave_spur_derive_tangent, NULL, spherical_concave_spur_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
    { "spherical_spur_convex", spherical_spur_convex_derive_tangent, NULL, spherical_spur_convex_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
    { "spherical_spur_concave", spherical_spur_concave_derive_tangent, NULL, spherical_spur_concave_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
    { "spherical_spur_spur", spherical_spur_spur_derive_tangent, NULL, spherical_spur_spur_tangent },
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
    { "face_worm", face_worm_derive_tangent, face_worm_system_tangents, face_worm_tangent },
#endif
};
