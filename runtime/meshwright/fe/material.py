"""Linear elastic materials and the contact modulus of two of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Material:
    """An isotropic linear elastic material.

    youngs_modulus: Young's modulus E in MPa, above zero.
    poisson_ratio: Poisson's ratio, -1 < nu < 0.5.
    """

    youngs_modulus: float
    poisson_ratio: float

    @property
    def plane_strain_modulus(self) -> float:
        """E / (1 - nu^2) in MPa."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)

    @property
    def lame(self) -> tuple[float, float]:
        """Lamé's constants λ and μ in MPa."""
        nu = self.poisson_ratio
        shear = 0.5 * self.youngs_modulus / (1.0 + nu)
        return 2.0 * shear * nu / (1.0 - 2.0 * nu), shear


def contact_modulus(first: Material, second: Material) -> float:
    """Contact modulus E* in MPa: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2."""
    return 1.0 / (1.0 / first.plane_strain_modulus + 1.0 / second.plane_strain_modulus)


def von_mises(stress: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """Von Mises stress of (..., 6) stresses, order xx yy zz xy yz zx."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(np.asarray(stress), -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))


def max_principal(stress: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """Largest principal stress of (..., 6) stresses, order xx yy zz xy yz zx."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(np.asarray(stress), -1, 0)
    rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
    tensor = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    return np.linalg.eigvalsh(tensor)[..., -1]


STEEL = Material(206000.0, 0.3)


@dataclass(frozen=True)
class Materials:
    """Material of each member."""

    pinion: Material
    wheel: Material

    @classmethod
    def of_table(cls, table: dict[str, float | None]) -> Materials:
        """From a design's ``[material]`` table: a member's own key, else that of both, else steel."""

        def material(member: str) -> Material:
            def constant(key: str, default: float) -> float:
                own, both = table.get(f"{key}_{member}"), table.get(key)
                return next(value for value in (own, both, default) if value is not None)

            return Material(
                constant("youngs_modulus_mpa", STEEL.youngs_modulus), constant("poisson_ratio", STEEL.poisson_ratio)
            )

        return cls(material("pinion"), material("wheel"))
