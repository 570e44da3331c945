use linecontact::reference::*;
use linecontact::*;
fn main() {
    let hertz = Hertz::new(0.7, 0.3).unwrap();
    let form = PolynomialMap::new(hertz, 3, 0.3 * 3.0, 1.0).unwrap();
    let reach = f64::cosh(2.0 / 3.0);
    let b = body(&form, -reach, reach).unwrap();
    println!("{:?}", form.contacts());
    let contact = Contact::new(&Flat, &b).unwrap().kappa(1.3);
    let s = contact.solve(Control::Load(form.load(1.3))).unwrap();
    println!("{:?} {:?} {:?} {:?}", s.intervals(), s.report().trials(), s.cost(), s.limits_error());
    for x in [0.3, 0.5, 0.7, 0.8, 0.86, 0.9, 1.0, 1.1, 1.2] {
        println!("{x} {:?} h {}", s.gap_at(x), form.height(x));
    }
    println!("{:?}", s.certify());
    // superellipse
    let (a, bb, n) = (10.0f64, 8.0f64, 2.5f64);
    let se = Curve::new([-9.0, 9.0], move |x: f64| {
        let u = (x.abs() / a).powf(n);
        let r = 1.0 - u;
        let y = bb * (1.0 - r.powf(1.0 / n));
        let dy = bb * r.powf(1.0 / n - 1.0) * (x.abs() / a).powf(n - 1.0) / a * x.signum();
        CurvePoint { x, y, dx: 1.0, dy }
    });
    let groove = Curve::new([-5.0, 5.0], |x: f64| {
        let r = (1600.0 - x * x).sqrt();
        CurvePoint { x, y: 40.0 - r, dx: 1.0, dy: x / r }
    });
    let contact = Contact::new(&groove, &se).unwrap().contact_modulus(115e3);
    for f in [20.0, 100.0, 500.0, 1500.0] {
        match contact.solve(Control::Load(f)) {
            Ok(s) => println!(
                "{:?} {:?} {:?} {:?}",
                s.intervals(),
                s.report().trials(),
                s.cost(),
                s.limits_error()
            ),
            Err(e) => println!("{e}"),
        }
    }
}
