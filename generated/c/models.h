/* Every generated drive, for runtime/c. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#include "cylindrical_worm_za_za.h"
#include "cylindrical_worm_za_zi.h"
#include "cylindrical_worm_za_zn.h"
#include "cylindrical_worm_za_zk.h"
#include "cylindrical_worm_za_zc.h"
#include "cylindrical_worm_zi_za.h"
#include "cylindrical_worm_zi_zi.h"
#include "cylindrical_worm_zi_zn.h"
#include "cylindrical_worm_zi_zk.h"
#include "cylindrical_worm_zi_zc.h"
#include "cylindrical_worm_zn_za.h"
#include "cylindrical_worm_zn_zi.h"
#include "cylindrical_worm_zn_zn.h"
#include "cylindrical_worm_zn_zk.h"
#include "cylindrical_worm_zn_zc.h"
#include "cylindrical_worm_zk_za.h"
#include "cylindrical_worm_zk_zi.h"
#include "cylindrical_worm_zk_zn.h"
#include "cylindrical_worm_zk_zk.h"
#include "cylindrical_worm_zk_zc.h"
#include "cylindrical_worm_zc_za.h"
#include "cylindrical_worm_zc_zi.h"
#include "cylindrical_worm_zc_zn.h"
#include "cylindrical_worm_zc_zk.h"
#include "cylindrical_worm_zc_zc.h"
#include "spherical_convex_convex.h"
#include "spherical_convex_concave.h"
#include "spherical_convex_spur.h"
#include "spherical_concave_convex.h"
#include "spherical_concave_concave.h"
#include "spherical_concave_spur.h"
#include "spherical_spur_convex.h"
#include "spherical_spur_concave.h"
#include "spherical_spur_spur.h"
#include "face_worm.h"

static const mw_model *const mw_models[] = {
    &cylindrical_worm_za_za_model,
    &cylindrical_worm_za_zi_model,
    &cylindrical_worm_za_zn_model,
    &cylindrical_worm_za_zk_model,
    &cylindrical_worm_za_zc_model,
    &cylindrical_worm_zi_za_model,
    &cylindrical_worm_zi_zi_model,
    &cylindrical_worm_zi_zn_model,
    &cylindrical_worm_zi_zk_model,
    &cylindrical_worm_zi_zc_model,
    &cylindrical_worm_zn_za_model,
    &cylindrical_worm_zn_zi_model,
    &cylindrical_worm_zn_zn_model,
    &cylindrical_worm_zn_zk_model,
    &cylindrical_worm_zn_zc_model,
    &cylindrical_worm_zk_za_model,
    &cylindrical_worm_zk_zi_model,
    &cylindrical_worm_zk_zn_model,
    &cylindrical_worm_zk_zk_model,
    &cylindrical_worm_zk_zc_model,
    &cylindrical_worm_zc_za_model,
    &cylindrical_worm_zc_zi_model,
    &cylindrical_worm_zc_zn_model,
    &cylindrical_worm_zc_zk_model,
    &cylindrical_worm_zc_zc_model,
    &spherical_convex_convex_model,
    &spherical_convex_concave_model,
    &spherical_convex_spur_model,
    &spherical_concave_convex_model,
    &spherical_concave_concave_model,
    &spherical_concave_spur_model,
    &spherical_spur_convex_model,
    &spherical_spur_concave_model,
    &spherical_spur_spur_model,
    &face_worm_model,
    NULL
};
