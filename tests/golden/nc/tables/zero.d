BEGIN ZERO .D MM
NR      X         Y         Z
0       +0        +0        +0
2       +100      +50
[END]
