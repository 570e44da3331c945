//! The pressure of several contacts.

use super::super::hilbert_transform::BATCH;
use super::Several;
use crate::{Real, Side};

impl<T: Real> Several<T> {
    /// Returns the number of the contact in which a place lies.
    fn contact_with(&self, x: T) -> Option<usize> {
        let i = self.parts.partition_point(|part| part.on.right <= x);
        self.parts.get(i).filter(|part| part.on.contains(x)).map(|_| i)
    }

    /// Computes `P/κ`, zero in the gaps between the contacts.
    pub fn pressures(&self, x: &[T], pressures: &mut [T]) {
        let mut done = 0;
        while done < x.len() {
            let contact = self.contact_with(x[done]);
            let mut lanes = [x[done]; BATCH];
            let alike = |&&x: &&T| self.contact_with(x) == contact;
            let count = x[done..].iter().take(BATCH).take_while(alike).count();
            lanes[..count].copy_from_slice(&x[done..done + count]);
            let out = &mut pressures[done..done + count];
            done += count;
            let Some(i) = contact else {
                out.fill(T::zero());
                continue;
            };
            let part = &self.parts[i];
            let (own, root) = part.inside(&lanes, count);
            let [far, weight] = [self.far.far(i, lanes), self.weight.on_contact(i, lanes)];
            for (lane, pressure) in out.iter_mut().enumerate() {
                let x = lanes[lane];
                let near = self.far.near(i).filter(|&k| k != i);
                let others = self.outside(near, x, None) + far[lane] + self.terms.at(x);
                *pressure = (own[lane] + root[lane] * others) / (T::pi() * T::pi() * weight[lane]);
            }
        }
    }

    /// Estimates the error of `P/κ` at a place in one of the contacts.
    pub fn error(&self, x: T) -> T {
        let Some(i) = self.contact_with(x) else { return T::zero() };
        let (part, sixth) = (&self.parts[i], T::of(6.0));
        // An error of the edge integrals is an error of the edge singularities; the errors of other
        // contacts add to it.
        let others = self.parts.iter().enumerate().filter(|&(k, _)| k != i);
        let by_others = others.fold(T::zero(), |sum, (_, other)| {
            let away = (other.on.left - x).max(x - other.on.right);
            sum + other.moments.error / away
        });
        let root = part.on.chebyshev_weight(x);
        let of_edges = sixth * T::pi() * part.on.half_width() * part.moments.error / root;
        let scale = T::pi() * T::pi() * self.weight.on_contact(i, [x])[0].abs();
        (part.error(x) + of_edges + T::pi() * root * by_others) / scale
    }

    /// Returns the strength `K/κ` of the singularity at a limit, `P ≈ K/sin θ`; zero if it is free.
    pub fn strength(&self, contact: usize, side: Side) -> T {
        if !self.held()[contact][side] {
            return T::zero();
        }
        let scale = T::pi() * T::pi() * self.weight.beside_corner(contact, side);
        T::of(2.0) * self.at_end_by_each(contact, side) / scale
    }
}
