/* Every generated drive, for runtime/c. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
#include "cylindrical_worm_za_za.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
#include "cylindrical_worm_za_zi.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
#include "cylindrical_worm_za_zn.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
#include "cylindrical_worm_za_zk.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
#include "cylindrical_worm_za_zc.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
#include "cylindrical_worm_zi_za.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
#include "cylindrical_worm_zi_zi.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
#include "cylindrical_worm_zi_zn.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
#include "cylindrical_worm_zi_zk.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
#include "cylindrical_worm_zi_zc.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
#include "cylindrical_worm_zn_za.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
#include "cylindrical_worm_zn_zi.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
#include "cylindrical_worm_zn_zn.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
#include "cylindrical_worm_zn_zk.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
#include "cylindrical_worm_zn_zc.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
#include "cylindrical_worm_zk_za.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
#include "cylindrical_worm_zk_zi.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
#include "cylindrical_worm_zk_zn.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
#include "cylindrical_worm_zk_zk.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
#include "cylindrical_worm_zk_zc.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
#include "cylindrical_worm_zc_za.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
#include "cylindrical_worm_zc_zi.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
#include "cylindrical_worm_zc_zn.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
#include "cylindrical_worm_zc_zk.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
#include "cylindrical_worm_zc_zc.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
#include "spherical_convex_convex.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
#include "spherical_convex_concave.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
#include "spherical_convex_spur.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
#include "spherical_concave_convex.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
#include "spherical_concave_concave.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
#include "spherical_concave_spur.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
#include "spherical_spur_convex.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
#include "spherical_spur_concave.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
#include "spherical_spur_spur.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
#include "face_worm.h"
#endif

static const mw_model *const mw_models[] = {
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
    &cylindrical_worm_za_za_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
    &cylindrical_worm_za_zi_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
    &cylindrical_worm_za_zn_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
    &cylindrical_worm_za_zk_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
    &cylindrical_worm_za_zc_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
    &cylindrical_worm_zi_za_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
    &cylindrical_worm_zi_zi_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
    &cylindrical_worm_zi_zn_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
    &cylindrical_worm_zi_zk_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
    &cylindrical_worm_zi_zc_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
    &cylindrical_worm_zn_za_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
    &cylindrical_worm_zn_zi_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
    &cylindrical_worm_zn_zn_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
    &cylindrical_worm_zn_zk_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
    &cylindrical_worm_zn_zc_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
    &cylindrical_worm_zk_za_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
    &cylindrical_worm_zk_zi_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
    &cylindrical_worm_zk_zn_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
    &cylindrical_worm_zk_zk_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
    &cylindrical_worm_zk_zc_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
    &cylindrical_worm_zc_za_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
    &cylindrical_worm_zc_zi_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
    &cylindrical_worm_zc_zn_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
    &cylindrical_worm_zc_zk_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
    &cylindrical_worm_zc_zc_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
    &spherical_convex_convex_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
    &spherical_convex_concave_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
    &spherical_convex_spur_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
    &spherical_concave_convex_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
    &spherical_concave_concave_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
    &spherical_concave_spur_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
    &spherical_spur_convex_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
    &spherical_spur_concave_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
    &spherical_spur_spur_model,
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
    &face_worm_model,
#endif
    NULL
};
