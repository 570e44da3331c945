//! x
use linecontact::*;
use linecontact::profile::*;
fn main() {
    let l = |e: f64, nu: f64, thickness: f64, base| Layer { material: Material::elastic(e, nu), thickness, base };
    let half = |e: f64, nu: f64| Base::HalfPlane(Material::elastic(e, nu));
    let ratio: f64 = std::env::args().nth(1).unwrap().parse().unwrap();
    let load: f64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let arc = Ellipse::circle(10.0, [-1.5, 1.5]).unwrap();
    let c = Contact::new(&Flat, &arc).unwrap().materials(Material::elastic(210e3, 0.3), l(210e3 * ratio, 0.3, 0.003, half(210e3, 0.3)), PlaneState::Strain);
    let t = std::time::Instant::now();
    let s = c.solve(Control::Load(load)).unwrap();
    println!("{:?} {} {:?}", s.intervals(), s.cost(), t.elapsed());
}
