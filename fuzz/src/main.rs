//! Random scenes against an independent oracle: see README.md.

mod nonsense;
mod oracle;
mod rough;
mod scene;

use std::process::ExitCode;

/// Xorshift generator: the same scenes everywhere.
struct Rng(u64);

impl Rng {
    fn new(seed: u64) -> Self {
        let mut rng = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        for _ in 0..5 {
            rng.bits();
        }
        rng
    }

    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// Returns a number from 0 to 1, evenly distributed.
    fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.share()
    }

    /// Returns a number whose logarithm is evenly distributed.
    fn scale(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() >> 33) as usize % n
    }

    fn chance(&mut self, share: f64) -> bool {
        self.share() < share
    }
}

/// Seeds that have failed, run with all others: panels were halved until the memory was exhausted.
const FAILED: [u64; 1] = [102_129];

pub(crate) fn main() -> ExitCode {
    let mut numbers = std::env::args().skip(1).map(|word| word.parse::<u64>().ok());
    let (Some(Some(from)), Some(Some(to))) = (numbers.next(), numbers.next()) else {
        eprintln!("two seeds, please: FROM TO");
        return ExitCode::from(2);
    };
    std::panic::set_hook(Box::new(|_| {}));
    let (mut findings, mut solved) = (0, 0);
    for seed in FAILED.into_iter().chain(from..to) {
        let run = || match seed % 10 {
            9 => nonsense::run(Rng::new(seed)),
            8 => rough::run(Rng::new(seed)),
            _ => scene::run(Rng::new(seed)),
        };
        match std::panic::catch_unwind(run) {
            Ok(Ok(found)) => solved += usize::from(found),
            Ok(Err(finding)) => {
                findings += 1;
                println!("{seed} {finding}");
            }
            Err(panic) => {
                findings += 1;
                let text = panic.downcast_ref::<String>().map(String::as_str);
                println!(
                    "{seed} panic: {}",
                    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("?")
                );
            }
        }
    }
    println!("{} seeds, {solved} contacts, {findings} findings", to - from);
    if findings == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
