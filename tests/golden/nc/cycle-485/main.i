%LATHETOOL G71 *
; The cuboid really is 0.004 mm higher and lies 0.006 mm towards X+, with 39.994 mm of edge instead of 40.
; ZL is the nose over 50 at the contact, XL its way from the side at 280 or 320.
T11 G17 *
; TO 1, tip to X- and down: ZL 50.004 + 99.97 - 50 = 99.974, XL 320 - (320.003 + 40.021) = -40.024
G485 MEASURE LATHE TOOL ~
    Q340=+1 ~
    Q260=+200 *
Q1600 = Q115 *
Q1601 = Q116 *
Q1602 = Q199 *
; DZL counts from the next call
T11 G17 *
Q1603 = Q114 *
; worn: LTOL 0.025 lies between the deviations 0.024 and 0.026
D17: SYSWRITE ID50 NR16 IDX11 = +0.025 *
G485 MEASURE LATHE TOOL ~
    Q340=+2 ~
    Q260=+200 *
Q1604 = Q199 *
D18: SYSREAD Q1605 = ID50 NR7 IDX11 *
; on LTOL
D17: SYSWRITE ID50 NR16 IDX11 = +0.026 *
G485 MEASURE LATHE TOOL ~
    Q340=+1 ~
    Q260=+200 *
Q1606 = Q199 *
; measured anew: ZL and XL, and nothing differs from them
G485 MEASURE LATHE TOOL ~
    Q340=+0 ~
    Q260=+200 *
Q1610 = Q115 *
Q1611 = Q116 *
G485 MEASURE LATHE TOOL ~
    Q340=+2 ~
    Q260=+200 *
Q1612 = Q115 *
Q1613 = Q116 *
T11 G17 *
Q1614 = Q114 *
T12 G17 *
; TO 2, tip to X-, RS 3 below it: ZL 50.004 + 3 + 119.981 - 50 - 3 = 119.985, XL 320 - (320.003 + 60.007) = -60.01
G485 MEASURE LATHE TOOL ~
    Q340=+2 ~
    Q260=+200 *
Q1620 = Q115 *
Q1621 = Q116 *
T13 G17 *
; TO 8, tip down, RS 1.5 to both sides: ZL 90.024, XL 280 - 1.5 - (280.009 - 1.5 - 5.005) = 4.996
G485 MEASURE LATHE TOOL ~
    Q340=+2 ~
    Q260=+200 *
Q1630 = Q115 *
Q1631 = Q116 *
T14 G17 *
; TO 7, tip to X+ and down, chipped: ZL 109.504, XL 280 - (280.009 - 30) = 29.991
G485 MEASURE LATHE TOOL ~
    Q340=+1 ~
    Q260=+200 *
Q1640 = Q115 *
Q1641 = Q116 *
Q1642 = Q199 *
T14 G17 *
N99999999 %LATHETOOL G71 *
